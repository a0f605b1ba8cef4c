// A 3D map of distances to the solid under the declared surface, for sphere tracing (Donnelly 2005, "Per-Pixel Displacement Mapping
// with Distance Functions", GPU Gems 2, ch. 8), safe for every point that reads it.
#pragma once

#include "core/height_field.h"
#include "core/map_set.h"
#include "core/progress.h"

namespace relievo {

// One channel, MapSet::distance's layout: distance_slices slices of at most 512 x 512 voxels (never more than the field has texels),
// stacked upward. Voxel (i, j, k) stands at u = (i + 0.5) / width, v = (j + 0.5) / height, z = k / (distance_slices - 1).
//
// Unit: heights, in the metric  |(du, dv) / height_scale, dz|. What a value holds is a lower bound: let d(p) be the Euclidean distance
// from p to the nearest point of  {z <= h(u,v)}, h bilinear and repeated (0 inside). Then the trilinear blend of the stored values at
// any p is at most d(p), and so is the value of the nearest voxel reduced by half a voxel's diagonal. Below about half a diagonal the
// values go through 0 to negative ones: near the surface the map says "not this close" and the heights have to be asked.
//
// height_scale (UV units, at least 0) is raised to eight voxels where it is less: balls of a larger scale are safe in a smaller one.
// Independent of the number of threads (0: all cores). `progress` may throw Cancelled.
ImageF distance_map(const HeightField& field, float height_scale, int threads = 0, const Progress& progress = {});

}  // namespace relievo
