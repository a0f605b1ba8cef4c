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

// The same where forces bend strands further: `push`, in the skin, is by how much more the tip leans, and adds to the angle in proportion to the height.
// The lean then turns along the strand, and its integral has no closed form: three points after Gauss, within 0.001 of the length.
vec3 leaning(vec3 normal, vec3 lean) {
    float angle = length(lean);
    return normal * cos(angle) + lean * (angle > 1e-4f ? sin(angle) / angle : 1.0f);
}

StrandShape pushed_shape(vec3 normal, vec3 comb, vec3 push, float level, float tilt, float bend) {
    vec3 grown = comb / max(length(comb), 1.0f);
    vec3 start = grown * tilt, turn = (grown * bend + push) * level;
    StrandShape shape;
    shape.offset = (leaning(normal, start + turn * 0.1127017f) * 0.2777778f + leaning(normal, start + turn * 0.5f) * 0.4444444f +
                    leaning(normal, start + turn * 0.8872983f) * 0.2777778f) * level;
    shape.tangent = leaning(normal, start + turn);
    return shape;
}
