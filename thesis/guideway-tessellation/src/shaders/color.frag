// Writes the color that all lines share.
layout(location = 0) out vec4 rgba;

void main() {
    rgba = color;
}
