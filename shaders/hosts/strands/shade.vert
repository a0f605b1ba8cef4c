// The whole picture, as a strip of two triangles.
#version 460

void main() { gl_Position = vec4(float(gl_VertexIndex & 1) * 2.0f - 1.0f, float(gl_VertexIndex >> 1) * 2.0f - 1.0f, 0.0f, 1.0f); }
