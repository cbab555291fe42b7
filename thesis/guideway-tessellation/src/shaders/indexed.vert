// Converts a control point, selected by the index buffer, to pixels.
layout(location = POINT) in vec2 point_m;

void main() {
    gl_Position = vec4(pixel_from_world(point_m), 0.0, 1.0);
}
