// Vehicles on the map: their positions, the way from one message to the next, and how they look.

import type { Point } from "./answers.js";
import { GuidewayError } from "./engine.js";
import type { View } from "./map.js";

/** A vehicle at a position of the layout. */
export interface Vehicle {
  id: string;
  /** Meters. */
  x: number;
  y: number;
  /** Radians, counterclockwise from the x axis; a vehicle without heading is a disc. */
  theta?: number;
  /** Id or name of its level; without it, the vehicle is on all levels. */
  level?: string;
  /** Text beside it: its id by default. */
  label?: string;
  /** CSS color. */
  color?: string;
  /** Meters: 1.2 and 0.8 by default. */
  lengthM?: number;
  widthM?: number;
}

interface Pose {
  x: number;
  y: number;
  theta?: number;
}

/** A vehicle on its way. */
interface Motion {
  from: Pose;
  to: Vehicle;
  startMs: number;
  durationMs: number;
}

/** The picture into which vehicles are painted. */
export interface Sheet {
  pen: CanvasRenderingContext2D;
  at: (point: Point) => Point;
  view: View;
  /** Pixels per point. */
  scale: number;
  /** Colors of paper and ink. */
  paper: string;
  ink: string;
  accent: string;
}

/** Least length of a vehicle in points, so that it is seen from afar. */
const MIN_LENGTH = 16;
/** Largest reach of the pointer around a vehicle, in points. */
const REACH = 10;

export class Fleet {
  private motions = new Map<string, Motion>();
  /** Returns `true` if vehicles of a level are shown. */
  isShown: (level: string | undefined) => boolean = () => true;

  /** Replaces all vehicles. Those that are elsewhere now go there within `durationMs`. */
  set(vehicles: Iterable<Vehicle>, durationMs: number, nowMs: number): void {
    const motions = new Map<string, Motion>();
    for (const to of vehicles) {
      if (![to.x, to.y, to.theta ?? 0].every(Number.isFinite)) {
        const message = `vehicle ${to.id}: position and heading must be finite numbers`;
        throw new GuidewayError("usage", message, "Give `x` and `y` in meters, `theta` in radians");
      }
      const before = this.motions.get(to.id);
      if (!before || before.to.level !== to.level) {
        motions.set(to.id, { from: to, to, startMs: nowMs, durationMs: 0 });
      } else if (isSame(before.to, to)) {
        motions.set(to.id, { ...before, to });
      } else {
        motions.set(to.id, { from: poseAt(before, nowMs), to, startMs: nowMs, durationMs });
      }
    }
    this.motions = motions;
  }

  get(id: string): Vehicle | undefined {
    return this.motions.get(id)?.to;
  }

  isMoving(nowMs: number): boolean {
    return [...this.motions.values()].some((of) => nowMs < of.startMs + of.durationMs);
  }

  /** The vehicle at a world point, the topmost one. */
  hit([x, y]: Point, view: View, scale: number, nowMs: number): Vehicle | undefined {
    const shown = [...this.motions.values()].filter(({ to }) => this.isShown(to.level));
    const isThere = (of: Motion) => {
      const pose = poseAt(of, nowMs);
      const reach = Math.max(sizePx(of.to, view, scale)[0] / 2, REACH * scale) / view.pxPerM;
      return Math.hypot(pose.x - x, pose.y - y) <= reach;
    };
    return shown.reverse().find(isThere)?.to;
  }

  paint(sheet: Sheet, marked: string | undefined, nowMs: number): void {
    for (const of of this.motions.values()) {
      if (!this.isShown(of.to.level)) continue;
      paintVehicle(sheet, of.to, poseAt(of, nowMs), of.to.id === marked);
    }
  }
}

function isSame(a: Pose, b: Pose): boolean {
  return a.x === b.x && a.y === b.y && a.theta === b.theta;
}

/** Between two positions on a line, between two headings the shorter way round. */
function poseAt({ from, to, startMs, durationMs }: Motion, nowMs: number): Pose {
  const share = durationMs > 0 ? Math.min(Math.max((nowMs - startMs) / durationMs, 0), 1) : 1;
  const pose: Pose = {
    x: from.x + (to.x - from.x) * share,
    y: from.y + (to.y - from.y) * share,
  };
  if (to.theta === undefined) return pose;
  const turn = from.theta === undefined ? 0 : to.theta - from.theta;
  const shorter = turn - 2 * Math.PI * Math.round(turn / (2 * Math.PI));
  return { ...pose, theta: to.theta - shorter * (1 - share) };
}

/** Length and width on the screen. */
function sizePx({ lengthM = 1.2, widthM = 0.8 }: Vehicle, view: View, scale: number) {
  const grown = Math.max(1, (MIN_LENGTH * scale) / (lengthM * view.pxPerM));
  const size: Point = [lengthM * view.pxPerM * grown, widthM * view.pxPerM * grown];
  return size;
}

function paintVehicle(sheet: Sheet, vehicle: Vehicle, pose: Pose, isMarked: boolean): void {
  const { pen, scale, paper, ink, accent } = sheet;
  const [length, width] = sizePx(vehicle, sheet.view, scale);
  const [x, y] = sheet.at([pose.x, pose.y]);
  pen.save();
  pen.translate(x, y);
  pen.save();
  pen.beginPath();
  if (pose.theta === undefined) {
    pen.arc(0, 0, width / 2, 0, 2 * Math.PI);
  } else {
    pen.rotate(-pose.theta);
    pen.roundRect(-length / 2, -width / 2, length, width, width / 5);
  }
  pen.lineWidth = (isMarked ? 7 : 3) * scale;
  pen.strokeStyle = isMarked ? accent : paper;
  pen.stroke();
  pen.fillStyle = vehicle.color ?? accent;
  pen.fill();
  if (pose.theta !== undefined) {
    pen.beginPath();
    pen.moveTo(length * 0.42, 0);
    pen.lineTo(length * 0.16, -width * 0.3);
    pen.lineTo(length * 0.16, width * 0.3);
    pen.fillStyle = "#ffffff";
    pen.fill();
  }
  pen.restore();
  const label = vehicle.label ?? vehicle.id;
  if (label) {
    pen.font = `600 ${12 * scale}px system-ui, sans-serif`;
    pen.textAlign = "center";
    pen.textBaseline = "bottom";
    const above = -Math.max(length, width) / 2 - 3 * scale;
    pen.lineJoin = "round";
    pen.lineWidth = 3 * scale;
    pen.strokeStyle = paper;
    pen.strokeText(label, 0, above);
    pen.fillStyle = ink;
    pen.fillText(label, 0, above);
  }
  pen.restore();
}

/** The vehicle of a VDA 5050 message with a position (`visualization` or `state`, version 1 to 3);
 * nothing if the vehicle does not know where it is. */
export function vehicleOf(message: unknown): Vehicle | undefined {
  const { manufacturer, serialNumber, ...fields } = (message ?? {}) as Record<string, unknown>;
  const position = (fields["agvPosition"] ?? fields["mobileRobotPosition"]) as
    | Record<string, unknown>
    | undefined;
  if (!position) return undefined;
  const { x, y, theta, mapId, positionInitialized, localized } = position;
  const isLost = positionInitialized === false || localized === false;
  if (isLost || typeof x !== "number" || typeof y !== "number") return undefined;
  return {
    id: [manufacturer, serialNumber].filter(Boolean).join("/"),
    label: String(serialNumber ?? ""),
    x,
    y,
    ...(typeof theta === "number" ? { theta } : {}),
    ...(typeof mapId === "string" ? { level: mapId } : {}),
  };
}
