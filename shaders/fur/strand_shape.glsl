// The axis that the strands around a place have in common: an arc that leaves the skin tilted and bends on toward the tip.
// `comb` lies in the skin; the shorter it is, the more upright they stand.
struct StrandShape {
    vec3 offset;   // from the root to the point at `level`, in lengths
    vec3 tangent;  // unit, there
};

StrandShape strand_shape(vec3 normal, vec3 comb, float level, float tilt, float bend) {
    float combed = min(length(comb), 1.0f);
    vec3 along = combed > 1e-4f ? comb / length(comb) : vec3(0.0f);
    float start = tilt * combed;
    float turn = max(bend * combed, 1e-3f);
    float angle = start + turn * level;
    StrandShape shape;
    // The integral of cos(angle) normal + sin(angle) along.
    shape.offset = (normal * (sin(angle) - sin(start)) + along * (cos(start) - cos(angle))) / turn;
    shape.tangent = normal * cos(angle) + along * sin(angle);
    return shape;
}
