// A descending ray against one cell of the declared surface, h(u,v) = a + b u + c v + d u v on the unit square.
// Along the ray the gap h - z is a quadratic in the descent, solved in the stable form that never subtracts nearly equal terms
// (exact_casting in the docs; Press et al., Numerical Recipes, 5.6).
#ifndef RELIEVO_SURFACE_BILINEAR_PATCH
#define RELIEVO_SURFACE_BILINEAR_PATCH

// Descent at which the ray first meets the patch, or -1. corners = h00, h10, h01, h11; entry = position in the cell at descent
// 0, where the ray's height is z; speed = cells per unit of descent; limit = descent at which the ray leaves the cell.
float patch_descent(vec4 corners, vec2 entry, float z, vec2 speed, float limit) {
    float b = corners.y - corners.x;
    float c = corners.z - corners.x;
    float d = (corners.w - corners.z) - b;
    float gap = corners.x + b * entry.x + c * entry.y + d * entry.x * entry.y - z;
    float result = -1.0f;
    if (gap >= 0.0f) {
        result = 0.0f;
    } else {
        float qa = d * speed.x * speed.y;
        float qb = b * speed.x + c * speed.y + d * (entry.x * speed.y + entry.y * speed.x) + 1.0f;
        float discriminant = qb * qb - 4.0f * qa * gap;
        if (discriminant >= 0.0f) {
            // With the gap below 0 one candidate is left of the two roots: closing from the start, the nearer; opening at first,
            // it closes only where the profile bends upward.
            float root = -1.0f;
            if (qb >= 0.0f) {
                float q = -0.5f * (qb + sqrt(discriminant));
                if (q < 0.0f) root = gap / q;
            } else if (qa > 0.0f) {
                root = 0.5f * (sqrt(discriminant) - qb) / qa;
            }
            if (root >= 0.0f && root <= limit) result = root;
        }
    }
    return result;
}

#endif
