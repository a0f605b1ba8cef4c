// Fur that gives way: a spring at every vertex, bent by gravity, wind and the motion of the skin.
#pragma once

#include "core/mesh.h"
#include "fur/coat.h"
#include "fur/strand_curves.h"

#include <vector>

namespace relievo {

// A strand leans by an angle that grows along it; its tip, from the normal by the vector a = comb (tilt + bend) + push, which lies in the skin and
// is as long as the angle. `push` is what forces add to how the strand grew. It adds to the angle in proportion to the height, and to where the
// strand is therefore in proportion to the square of the height, as a load at the tip bends a beam that is held at its foot.
//
// A pull f on the strand, in units of earth's gravity, has the potential -f.s(a) where s(a) = cos|a| N + sin|a| a/|a| is the direction of its tip.
// With w its angular frequency, z its damping ratio and b its softness, the angle at which a pull of 1 across it would hold it:
//     push'' = w^2 (b grad(f.s) - push) - 2 z w push'
// Strands of length L are softer as L^3 and slower as 1/L^2 (Euler and Bernoulli's beam).
struct FurMotion {
    std::vector<Vec3d> push;   // of each vertex, radians
    std::vector<Vec3d> speed;  // radians a second
};

// All in fur space.
struct FurForces {
    Vec3d gravity;        // in units of earth's gravity
    Vec3d wind;           // the pull of the air on a strand across it, in the same unit
    double gusts = 0;     // by which share of itself the wind swells and falls, in hills that it carries along; at most 1
    double time = 0;      // seconds, for the gusts
    Vec3d spin;           // of the mesh around the origin, radians a second; forces are told in its own space
    Vec3d spin_change;    // radians a second, a second
};

// The skin that moves: unit normals, a comb for each vertex and shares of length in [0,1] (empty: 1 everywhere).
struct FurSkin {
    const Mesh& mesh;
    const std::vector<Vec3f>& comb;
    std::span<const float> lengths;
    const Coat& coat;
};

// Strands lie no flatter than this, radians from the normal: there they meet the skin, and lose the speed with which they do.
inline constexpr double flattest = 1.45;

FurMotion at_rest(const FurSkin& skin);

// `seconds` later, in one step. Second order, and without forces that change with time never of more energy than before, at any length of step
// (implicit midpoint with the discrete gradient of Gonzalez 1996, "Time Integration and Discrete Hamiltonian Systems"). Steps of 1/240 s follow
// the swing of every coat there is. A function of its arguments alone: the same for any `threads`.
FurMotion after(const FurMotion& motion, const FurSkin& skin, const FurForces& forces, double seconds, int threads = 0);

// Where forces that do not change hold the fur for good.
FurMotion settled(const FurSkin& skin, const FurForces& forces, int threads = 0);

// For each vertex half the square of its speed and the potentials of its spring and of the forces, in radians^2 a second^2.
std::vector<double> energies(const FurMotion& motion, const FurSkin& skin, const FurForces& forces);

// As programs and curves take it.
std::vector<Vec3f> pushes_of(const FurMotion& motion);

}  // namespace relievo
