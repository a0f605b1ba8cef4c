// A height field in Embree 3, the baseline of the casters' benchmarks: as a grid (its leanest geometry for height fields) or as two
// triangles a cell. Not the same surface: where a cell is twisted, triangles differ from the bilinear patch.
#pragma once

#include "core/height_field.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <vector>

namespace relievo {

enum class EmbreeGeometry { grid, triangles };

// Rays for packets of 16, in Embree's own layout, made once so that no time goes into it.
struct EmbreePackets {
    struct alignas(64) Packet {
        RTCRay16 ray;
    };
    std::vector<Packet> packets;
};

// A straight way from `from` to `to`, in UV and, across the plane, in UV as well.
struct EmbreeRay {
    float from[3];
    float to[3];
};

// u, v and the share of the way, for each ray.
struct EmbreeHit {
    float u, v, distance;
};

inline EmbreePackets embree_packets(const std::vector<EmbreeRay>& rays) {
    EmbreePackets all;
    all.packets.resize(rays.size() / 16);
    for (std::size_t k = 0; k < all.packets.size() * 16; ++k) {
        RTCRay16& r = all.packets[k / 16].ray;
        const std::size_t lane = k % 16;
        r.org_x[lane] = rays[k].from[0], r.org_y[lane] = rays[k].from[1], r.org_z[lane] = rays[k].from[2];
        r.dir_x[lane] = rays[k].to[0] - rays[k].from[0], r.dir_y[lane] = rays[k].to[1] - rays[k].from[1],
        r.dir_z[lane] = rays[k].to[2] - rays[k].from[2];
        r.tnear[lane] = 0, r.time[lane] = 0, r.tfar[lane] = 1.01f;  // the floor is on the way, not behind its end by rounding
        r.mask[lane] = ~0u, r.id[lane] = 0, r.flags[lane] = 0;
    }
    return all;
}

class EmbreeSurface {
public:
    // Texels first to last (beyond a period: repeated) in both directions; heights times height_scale. Built for quality.
    EmbreeSurface(const HeightField& field, double height_scale, EmbreeGeometry geometry, int first, int last)
        : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
        rtcSetDeviceMemoryMonitorFunction(
            device_,
            [](void* held, ssize_t bytes, bool) {
                *static_cast<std::atomic<std::ptrdiff_t>*>(held) += bytes;
                return true;
            },
            &bytes_);
        const auto side = static_cast<unsigned>(last - first + 1);
        const bool is_grid = geometry == EmbreeGeometry::grid;
        RTCGeometry mesh = rtcNewGeometry(device_, is_grid ? RTC_GEOMETRY_TYPE_GRID : RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                     3 * sizeof(float), static_cast<std::size_t>(side) * side));
        for (int j = first; j <= last; ++j) {
            for (int i = first; i <= last; ++i) {
                *vertices++ = static_cast<float>((i + 0.5) / field.width());
                *vertices++ = static_cast<float>((j + 0.5) / field.height());
                *vertices++ = static_cast<float>(field.wrapped(i, j) * height_scale);
            }
        }
        if (is_grid) {
            auto* description =
                static_cast<RTCGrid*>(rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_GRID, 0, RTC_FORMAT_GRID, sizeof(RTCGrid), 1));
            *description = {0, side, static_cast<unsigned short>(side), static_cast<unsigned short>(side)};
        } else {
            auto* corner = static_cast<unsigned*>(rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                          3 * sizeof(unsigned),
                                                                          2 * static_cast<std::size_t>(side - 1) * (side - 1)));
            for (unsigned j = 0; j + 1 < side; ++j) {
                for (unsigned i = 0; i + 1 < side; ++i) {
                    const unsigned a = j * side + i;
                    for (const unsigned c : {a, a + 1, a + side, a + 1, a + side + 1, a + side}) *corner++ = c;
                }
            }
        }
        rtcSetGeometryBuildQuality(mesh, RTC_BUILD_QUALITY_HIGH);
        rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
        rtcCommitGeometry(mesh);
        rtcAttachGeometry(scene_, mesh);
        rtcReleaseGeometry(mesh);
        rtcCommitScene(scene_);
    }
    ~EmbreeSurface() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    EmbreeSurface(const EmbreeSurface&) = delete;
    EmbreeSurface& operator=(const EmbreeSurface&) = delete;

    // What it holds.
    std::ptrdiff_t bytes() const { return bytes_; }

    // Packets [begin, end), with the hits' places written out.
    void packet16(const EmbreePackets& all, std::size_t begin, std::size_t end, EmbreeHit* hits) const {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;  // else a packet is taken apart into single rays
        alignas(64) int valid[16];
        std::fill(valid, valid + 16, -1);
        for (std::size_t p = begin; p < end; ++p) {
            alignas(64) RTCRayHit16 hit;
            hit.ray = all.packets[p].ray;
            std::fill(hit.hit.geomID, hit.hit.geomID + 16, RTC_INVALID_GEOMETRY_ID);
            rtcIntersect16(valid, scene_, &context, &hit);
            for (int k = 0; k < 16; ++k) {
                const float t = hit.ray.tfar[k];
                hits[p * 16 + static_cast<std::size_t>(k)] = {hit.ray.org_x[k] + t * hit.ray.dir_x[k],
                                                              hit.ray.org_y[k] + t * hit.ray.dir_y[k], t};
            }
        }
    }

    void single(const std::vector<EmbreeRay>& rays, EmbreeHit* hits) const {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        for (std::size_t k = 0; k < rays.size(); ++k) {
            const EmbreeRay& r = rays[k];
            RTCRayHit hit{};
            hit.ray.org_x = r.from[0], hit.ray.org_y = r.from[1], hit.ray.org_z = r.from[2];
            hit.ray.dir_x = r.to[0] - r.from[0], hit.ray.dir_y = r.to[1] - r.from[1], hit.ray.dir_z = r.to[2] - r.from[2];
            hit.ray.tfar = 1.01f;
            hit.ray.mask = ~0u;
            hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
            rtcIntersect1(scene_, &context, &hit);
            const float t = hit.ray.tfar;
            hits[k] = {r.from[0] + t * hit.ray.dir_x, r.from[1] + t * hit.ray.dir_y, t};
        }
    }

private:
    std::atomic<std::ptrdiff_t> bytes_{0};
    RTCDevice device_;
    RTCScene scene_;
};

}  // namespace relievo
