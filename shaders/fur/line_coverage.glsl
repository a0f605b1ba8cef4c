// The share of a pixel that a strand covers: a stripe of half width `radius`, `distance` from the pixel's middle, under a box filter as
// wide as the pixel. All three in one unit of length, on the plane of the strand.
float line_coverage(float distance, float radius, float pixel) {
    float half_pixel = 0.5f * pixel;
    return clamp((min(distance + radius, half_pixel) - max(distance - radius, -half_pixel)) / pixel, 0.0f, 1.0f);
}
