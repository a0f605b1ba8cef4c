// Textures looked up by a direction: environment maps, by which the 2009 thesis puts fur on meshes without texture coordinates.
#pragma once

#include "core/image.h"
#include "core/vec.h"

#include <string_view>
#include <vector>

namespace relievo {

enum class MapShape { cube, sphere };
struct MapShapeEntry {
    MapShape shape;
    std::string_view id;
    int faces;
    std::string_view summary;
};
inline constexpr MapShapeEntry map_shapes[] = {
    {MapShape::cube, "cube", 6, "six faces: every direction has texels of nearly one size"},
    {MapShape::sphere, "sphere", 1, "a disc cut out of one picture: texels grow toward its rim, where the direction -z is"},
};

// From a place on the mesh to the direction that is looked up, both in object space.
enum class Addressing { normal, position, normal_plus_position };
struct AddressingEntry {
    Addressing addressing;
    std::string_view id;
    std::string_view summary;
};
inline constexpr AddressingEntry addressings[] = {
    {Addressing::normal, "normal", "the normal"},
    {Addressing::position, "position", "the way from the origin"},
    {Addressing::normal_plus_position, "normal_plus_position", "the sum of both, each of unit length: what the thesis found best"},
};

// Of any length; nothing where the two parts of the sum cancel. The origin is the middle of the mesh.
Vec3d addressed(Addressing addressing, Vec3d position, Vec3d normal);

// u to the right and v down the picture of a face, [0,1].
struct MapPoint {
    int face = 0;
    double u = 0, v = 0;
};

// Cube: faces +x -x +y -y +z -z, as Direct3D, Vulkan and DDS files have them. Sphere: u = x / (2 m) + 1/2 and v likewise, where
// m = |direction + z| for a direction of unit length (the thesis' Algorithm 6); the disc's rim is the direction -z.
MapPoint map_point(MapShape shape, Vec3d direction);

// The other way, of unit length. Outside of the sphere's disc there is no direction: (0,0,0).
Vec3d map_direction(MapShape shape, const MapPoint& point);

struct DirectionMap {
    MapShape shape = MapShape::cube;
    bool colours = false;                     // RGB is sRGB-encoded
    std::vector<std::vector<Image8>> faces;  // of each the levels from the full size down to 1x1; RGBA, rows top to bottom, square
    int size() const { return faces.front().front().width; }
};

// Squares of four channels and equal size, a power of two, one a face, with their mip levels: means of 2x2, of colours in linear light.
// Of a sphere's picture what lies outside of the disc is made transparent.
DirectionMap direction_map(MapShape shape, std::vector<Image8> faces, bool colours);

// The picture as a square of `size` texels, each the mean, in linear light, of what lies under it; RGBA, of one to four channels.
Image8 square_picture(const Image8& picture, int size);

}  // namespace relievo
