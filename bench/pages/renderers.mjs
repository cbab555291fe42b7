// Renderers of pages. Each has `load(stage, lines)`, which ends with the first picture, and
// `draw(stage, shift)`, which ends with the picture of a view that is moved by a few pixels.

import { Deck, OrthographicView } from "@deck.gl/core";
import { PathLayer } from "@deck.gl/layers";
import maplibregl from "maplibre-gl/dist/maplibre-gl.js";

const WIDTH_PX = 1.5;
/** A picture is there once a pixel of it can be read. */
const finish = (gl) => gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));

/** The view of all lines: center in meters, pixels per meter. */
function viewOf({ box: [minX, minY, maxX, maxY] }, { clientWidth, clientHeight }) {
  const pxPerM = 0.95 * Math.min(clientWidth / (maxX - minX), clientHeight / (maxY - minY));
  return { center: [(minX + maxX) / 2, (minY + maxY) / 2], pxPerM };
}

const canvas = {
  async load(stage, lines) {
    this.view = viewOf(lines, stage);
    this.lines = lines;
    this.element = Object.assign(document.createElement("canvas"), {
      width: stage.clientWidth,
      height: stage.clientHeight,
    });
    stage.append(this.element);
    await this.draw(stage, 0);
  },
  draw(_, shift) {
    const { width, height } = this.element;
    const { center, pxPerM } = this.view;
    const { points, starts } = this.lines;
    const pen = this.element.getContext("2d", { willReadFrequently: true });
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.fillStyle = "#fff";
    pen.fillRect(0, 0, width, height);
    const [x0, y0] = [width / 2 - center[0] * pxPerM + shift, height / 2 + center[1] * pxPerM];
    pen.lineWidth = WIDTH_PX;
    // Path by path: one path of all lines takes many times as long.
    for (let i = 0; i + 1 < starts.length; i++) {
      pen.beginPath();
      for (let k = starts[i]; k < starts[i + 1]; k++) {
        pen.lineTo(x0 + points[2 * k] * pxPerM, y0 - points[2 * k + 1] * pxPerM);
      }
      pen.stroke();
    }
    pen.getImageData(0, 0, 1, 1);
  },
};

const deck = {
  load(stage, lines) {
    const { center, pxPerM } = viewOf(lines, stage);
    this.zoom = Math.log2(pxPerM);
    this.center = center;
    this.pxPerM = pxPerM;
    const data = {
      length: lines.starts.length - 1,
      startIndices: lines.starts,
      attributes: { getPath: { value: lines.points, size: 2 } },
    };
    return new Promise((resolve, reject) => {
      this.deck = new Deck({
        parent: stage,
        width: stage.clientWidth,
        height: stage.clientHeight,
        useDevicePixels: 1,
        views: new OrthographicView({ flipY: false }),
        viewState: this.viewState(0),
        onError: reject,
        layers: [
          new PathLayer({
            id: "lines",
            data,
            _pathType: "open",
            positionFormat: "XY",
            getWidth: WIDTH_PX,
            widthUnits: "pixels",
            getColor: [0, 0, 0, 255],
            capRounded: true,
          }),
        ],
        onAfterRender: ({ gl }) => {
          this.gl = gl ?? this.deck.device.gl;
          finish(this.gl);
          if (this.deck.layerManager?.getLayers().every((layer) => layer.isLoaded)) resolve();
        },
      });
    });
  },
  viewState(shift) {
    const target = [this.center[0] + shift / this.pxPerM, this.center[1], 0];
    return { target, zoom: this.zoom };
  },
  draw(_, shift) {
    this.deck.setProps({ viewState: this.viewState(shift) });
    this.deck.redraw("measured");
    finish(this.gl);
  },
};

/** Meters per degree at the equator, where the lines are put. */
const DEGREE_M = 111_319.49;

const maplibre = {
  async load(stage, { points, starts, box }) {
    const features = Array.from({ length: starts.length - 1 }, (_, i) => {
      const coordinates = [];
      for (let k = starts[i]; k < starts[i + 1]; k++) {
        coordinates.push([points[2 * k] / DEGREE_M, points[2 * k + 1] / DEGREE_M]);
      }
      return { type: "Feature", properties: {}, geometry: { type: "LineString", coordinates } };
    });
    const data = { type: "FeatureCollection", features };
    const [minX, minY, maxX, maxY] = box.map((value) => value / DEGREE_M);
    this.map = new maplibregl.Map({
      container: stage,
      bounds: [minX, minY, maxX, maxY],
      fadeDuration: 0,
      pixelRatio: 1,
      maxZoom: 24,
      style: {
        version: 8,
        sources: { lines: { type: "geojson", data, maxzoom: 22 } },
        layers: [
          { id: "paper", type: "background", paint: { "background-color": "#fff" } },
          { id: "lines", type: "line", source: "lines", paint: { "line-width": WIDTH_PX } },
        ],
      },
    });
    await new Promise((resolve) => this.map.once("idle", resolve));
    finish(this.map.painter.context.gl);
    this.center = this.map.project(this.map.getCenter());
  },
  draw(_, shift) {
    this.map.jumpTo({ center: this.map.unproject([this.center.x + shift, this.center.y]) });
    this.map.redraw();
    finish(this.map.painter.context.gl);
  },
};

const guideway = {
  async load(stage, _, file) {
    this.view = Object.assign(document.createElement("guideway-view"), { style: "height: 100%" });
    stage.append(this.view);
    this.view.setAttribute("shade", "color");
    await this.view.open(file);
    await this.drawn(0);
    this.place = this.view.view;
  },
  async drawn(before) {
    while (this.view.map.drawn === before) await new Promise((resolve) => setTimeout(resolve));
    this.view.map.canvas.getContext("2d").getImageData(0, 0, 1, 1);
  },
  async draw(_, shift) {
    const before = this.view.map.drawn;
    const { center, pxPerM } = this.place;
    this.view.view = { center: [center[0] + shift / pxPerM, center[1]], pxPerM };
    await this.drawn(before);
  },
};

globalThis.renderers = { canvas, deck, maplibre, guideway };
