// One color for all.
layout(location = 0) out vec4 rgba;

void main() {
    rgba = color;
}
