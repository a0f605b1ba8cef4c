// The rule of conservative_cone.cpp for corners and edges, in lanes. Included once for every kind of machine.
#include "maps/cone_search_lanes.h"

namespace relievo::cone_search::RELIEVO_MACHINE {

struct ConservativeRule : ConservativeCells {
    static constexpr int ring = 3;

    static void texel(Lanes d2, Lanes above, Lanes& k2) {
        const Lanes rise2 = above * above;
        k2 = rise2 > k2 * slack * d2 ? most(k2, rise2 * (1.0f / d2)) : k2;
    }

    // The two edges from a cell's first corner: every edge is one cell's.
    static void edges(const Corners& c, const Seen& seen, const Metric& m, Lanes& k2) {
        const Lanes rise = c.h00 - seen.apex;
        edge(rise, c.h10 - c.h00, seen.dy * seen.dy * m.v2, seen.dx, m.u2, k2);
        edge(rise, c.h01 - c.h00, seen.dx * seen.dx * m.u2, seen.dy, m.v2, k2);
    }

    // Along the edge from height `rise` with slope b a texel, at squared distance e2, the steepest point lies between the ends
    // where the derivative, b e2 - (rise - b along) s2 (along + v), falls from + to -; the squared slope there is a^2 / e2 + b^2 /
    // s2.
    static void edge(Lanes rise, Lanes b, Lanes e2, Lanes along, float s2, Lanes& k2) {
        const Lanes at_foot = rise - b * along;
        const Lanes first = b * e2 - at_foot * (s2 * along);
        const Lanes last = at_foot * s2;
        if ((bits_less(Lanes{}, first) & bits_less(first, last) &
             bits_less(k2 * slack * (e2 * s2), at_foot * at_foot * s2 + b * b * e2)) == 0)
            return;
        k2 = (first > 0.0f) & (first < last) ? most(k2, at_foot * at_foot * (1.0f / e2) + b * b * (1.0f / s2)) : k2;
    }
    static LaneMask between_ends(Lanes at_foot, Lanes b, Lanes e2, Lanes along_s2, float s2) {
        const Lanes first = b * e2 - at_foot * along_s2;
        return (first > 0.0f) & (first < at_foot * s2);
    }

    // Corners and edges up to `ring` texels away, whose distances are the same in every lane. To the bit what texel() and edge()
    // find.
    template <int reach>
    struct Near {
        static constexpr int size = 2 * reach + 1;
        float per_d2[size][size];
        float per_u2[size], per_v2[size];

        explicit Near(const Metric& m) {
            for (int j = 0; j < size; ++j) {
                const float d = static_cast<float>(j - reach);
                per_u2[j] = j == reach ? 0.0f : 1.0f / (d * d * m.u2);
                per_v2[j] = j == reach ? 0.0f : 1.0f / (d * d * m.v2);
                for (int i = 0; i < size; ++i) {
                    const float e = static_cast<float>(i - reach);
                    per_d2[j][i] = i == reach && j == reach ? 0.0f : 1.0f / (e * e * m.u2 + d * d * m.v2);
                }
            }
        }

        Lanes steepest(const Lanes (&height)[size][size], Lanes apex, const Metric& m) const {
            Lanes k2 = least_slope2 + Lanes{};
            for (int j = 0; j < size; ++j)
                for (int i = 0; i < size; ++i) {
                    const Lanes above = most(height[j][i] - apex, Lanes{});
                    k2 = most(k2, above * above * per_d2[j][i]);
                }
            const float per_x2 = 1.0f / m.u2;
            const float per_y2 = 1.0f / m.v2;
            for (int j = 0; j < size; ++j) {
                if (j == reach) continue;  // a line through the apex is steepest at an end of an edge
                const float across = static_cast<float>(j - reach);
                for (int i = 0; i + 1 < size; ++i) {
                    const float along = static_cast<float>(i - reach);
                    edge(height[j][i] - apex, height[j][i + 1] - height[j][i], across * across * m.v2, per_v2[j], along, m.u2,
                         per_x2, k2);
                    edge(height[i][j] - apex, height[i + 1][j] - height[i][j], across * across * m.u2, per_u2[j], along, m.v2,
                         per_y2, k2);
                }
            }
            for (const int j : {-1, 0})
                for (const int i : {-1, 0})
                    touching({height[reach + j][reach + i], height[reach + j][reach + i + 1], height[reach + j + 1][reach + i],
                              height[reach + j + 1][reach + i + 1]},
                             i, j, m, k2);
            return k2;
        }

        static void edge(Lanes rise, Lanes b, float e2, float per_e2, float along, float s2, float per_s2, Lanes& k2) {
            const Lanes at_foot = rise - b * along;
            const LaneMask between = between_ends(at_foot, b, e2 + Lanes{}, s2 * along + Lanes{}, s2);
            k2 = between ? most(k2, at_foot * at_foot * per_e2 + b * b * per_s2) : k2;
        }
    };

    // A cell that the texel is a corner of is steepest inside where its gradient at the texel rises along both axes and it is
    // twisted down.
    static void touching(const Corners& c, int i, int j, const Metric& m, Lanes& k2) {
        const Lanes bx = j == 0 ? c.h10 - c.h00 : c.h11 - c.h01;
        const Lanes by = i == 0 ? c.h01 - c.h00 : c.h11 - c.h10;
        const Lanes gx = i == 0 ? bx : -bx;
        const Lanes gy = j == 0 ? by : -by;
        const Lanes slope2 = gx * gx / m.u2 + gy * gy / m.v2;
        k2 = (gx > 0.0f) & (gy > 0.0f) & (slope2 > k2) ? slope2 : k2;
    }

    // Where a cone touches the surface inside a cell, the gradient points away from the texel and is as steep as the cone: some
    // gradient of the cell has to rise outward along both axes, and to be steeper than the cone that is there already. Besides,
    // twist X Y < 0 in the texel's quadrant, and where the slope along the ray is steepest X Hx + Y Hy - (H - h_x) = twist X Y - C
    // changes its sign. With a margin for rounding; inside() decides.
    static LaneMask may_bind_inside(const Corners& c, const Seen& seen, const Metric& m, Lanes k2) {
        const Lanes bx0 = c.h10 - c.h00;
        const Lanes bx1 = c.h11 - c.h01;
        const Lanes by0 = c.h01 - c.h00;
        const Lanes by1 = c.h11 - c.h10;
        const LaneMask right = seen.dx >= 0.0f;
        const LaneMask up = seen.dy >= 0.0f;
        const Lanes gx = most(right ? bx0 : -bx0, right ? bx1 : -bx1);
        const Lanes gy = most(up ? by0 : -by0, up ? by1 : -by1);
        const LaneMask touches = (gx > 0.0f) & (gy > 0.0f) & (gx * gx * m.v2 + gy * gy * m.u2 > k2 * (m.u2 * m.v2 * slack)) &
                                 ((right == up ? bx1 - bx0 : bx0 - bx1) < 0x1p-22f * (magnitude(bx0) + magnitude(bx1)));
        if (!any(touches)) return touches;
        const Lanes rise = c.h00 - seen.apex;
        const Lanes twist = bx1 - bx0;
        const Lanes product = seen.dx * seen.dy;
        const Lanes at_apex = rise - seen.dx * bx0 - seen.dy * by0 + twist * product;
        const Lanes t00 = twist * product - at_apex;
        const Lanes t10 = t00 + twist * seen.dy;
        const Lanes t01 = t00 + twist * seen.dx;
        const Lanes t11 = t10 + twist * (seen.dx + 1.0f);
        const Lanes steps = magnitude(bx0) + magnitude(bx1) + magnitude(by0) + magnitude(by1);
        const Lanes margin =
            0x1p-20f * ((magnitude(seen.dx) + magnitude(seen.dy) + magnitude(product) + 3.0f) * steps + magnitude(rise));
        return touches & (most(most(t00, t10), most(t01, t11)) >= -margin) & (least(least(t00, t10), least(t01, t11)) <= margin);
    }
};

inline void search_conservative(const Rows& rows) { search_rows<ConservativeRule>(rows); }

}  // namespace relievo::cone_search::RELIEVO_MACHINE
