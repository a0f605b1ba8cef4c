// One colour, unlit: it only has to be told from the relief (reference/cast.h has the same).
#version 460
layout(location = 0) out vec4 colour;

void main() { colour = vec4(0.02f, 0.08f, 0.12f, 1.0f); }
