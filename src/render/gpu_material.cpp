#include "render/gpu_material.h"

#include "core/error.h"
#include "gpu/half.h"
#include "gpu/volume.h"

#include <algorithm>
#include <cstring>

namespace relievo {

namespace {

// The extent of level 0 of a chain whose sizes are those of a Vulkan mip chain.
template <class T>
vk::Extent2D chain_extent(const gpu::Device& device, const std::vector<Image<T>>& chain, const char* name) {
    const auto limit = static_cast<int>(device.physical().getProperties().limits.maxImageDimension2D);
    const int width = chain.front().width;
    const int height = chain.front().height;
    if (width > limit || height > limit)
        throw Error("upload", std::string("the ") + name + " map",
                    "it is " + std::to_string(width) + " x " + std::to_string(height) + " and " + device.info().name +
                        " takes at most " + std::to_string(limit),
                    "scale the material down");
    for (std::size_t k = 0; k < chain.size(); ++k)
        if (chain[k].width != std::max(1, width >> k) || chain[k].height != std::max(1, height >> k))
            throw Error("upload", std::string("the ") + name + " map",
                        "its level " + std::to_string(k) + " is not half the level before it");
    return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

// A chain whose texels go to the device as they are.
template <class T>
gpu::Image plain_texture(const gpu::Device& device, vk::Format format, const std::vector<Image<T>>& chain, const char* name) {
    const auto extent = chain_extent(device, chain, name);
    const std::size_t texel = static_cast<std::size_t>(chain.front().channels) * sizeof(T);
    return gpu::make_texture(device, format, extent, static_cast<std::uint32_t>(chain.size()), texel,
                             [&](int level, int y, std::byte* out) {
                                 const Image<T>& image = chain[static_cast<std::size_t>(level)];
                                 std::memcpy(out, image.at(0, y), static_cast<std::size_t>(image.width) * texel);
                             });
}

// As half floats: normals need sign and about three digits, and 32 bits would cost a quarter of a gigabyte at 4096^2.
gpu::Image normal_texture(const gpu::Device& device, const std::vector<ImageF>& chain) {
    const auto extent = chain_extent(device, chain, "normal");
    return gpu::make_texture(device, vk::Format::eR16G16B16A16Sfloat, extent, static_cast<std::uint32_t>(chain.size()), 8,
                             [&](int level, int y, std::byte* out) {
                                 const ImageF& image = chain[static_cast<std::size_t>(level)];
                                 for (int x = 0; x < image.width; ++x) {
                                     const float* n = image.at(x, y);
                                     const std::uint16_t texel[4] = {gpu::to_half(n[0]), gpu::to_half(n[1]), gpu::to_half(n[2]), 0};
                                     std::memcpy(out + 8 * x, texel, 8);
                                 }
                             });
}

// As half floats: 0.04 degrees of the horizon's angle. A missing map is one texel of no horizon.
gpu::Image horizon_texture(const gpu::Device& device, const ImageF& map) {
    const int width = std::max(1, map.width);
    const int height = std::max(1, map.height);
    const auto limit = static_cast<int>(device.physical().getProperties().limits.maxImageDimension2D);
    if (width > limit || height > limit)
        throw Error("upload", "the horizon map", "it is larger than the " + std::to_string(limit) + " texels " + device.info().name + " takes",
                    "scale the material down");
    const int layers = map.empty() ? 1 : map.channels;
    return gpu::make_texture(
        device, vk::Format::eR16Sfloat, {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)}, 1, 2,
        [&](int, int row, std::byte* out) {
            for (int x = 0; x < width; ++x) {
                const std::uint16_t texel = map.empty() ? std::uint16_t{0} : gpu::to_half(map(x, row % height, row / height));
                std::memcpy(out + 2 * x, &texel, 2);
            }
        },
        static_cast<std::uint32_t>(layers));
}

template <class T>
std::vector<Image<T>> one_texel(std::initializer_list<T> texel) {
    Image<T> image(1, 1, static_cast<int>(texel.size()));
    std::ranges::copy(texel, image.texels.begin());
    return {std::move(image)};
}

// One level without copying it into a chain of its own.
template <class T>
gpu::Image single_texture(const gpu::Device& device, vk::Format format, const Image<T>& image, const char* name) {
    const auto limit = static_cast<int>(device.physical().getProperties().limits.maxImageDimension2D);
    if (image.width > limit || image.height > limit)
        throw Error("upload", std::string("the ") + name + " map",
                    "it is larger than the " + std::to_string(limit) + " texels " + device.info().name + " takes",
                    "scale the material down");
    const std::size_t texel = static_cast<std::size_t>(image.channels) * sizeof(T);
    return gpu::make_texture(
        device, format, {static_cast<std::uint32_t>(image.width), static_cast<std::uint32_t>(image.height)}, 1, texel,
        [&](int, int y, std::byte* out) { std::memcpy(out, image.at(0, y), static_cast<std::size_t>(image.width) * texel); });
}

// The map's values are half floats already (maps/distance_map.h). A missing map is one voxel on the surface.
gpu::Image distance_texture(const gpu::Device& device, const ImageF& map) {
    const int rows = map.height / distance_slices;
    const vk::Extent3D extent = map.empty() ? vk::Extent3D{1, 1, 1}
                                            : vk::Extent3D{static_cast<std::uint32_t>(map.width), static_cast<std::uint32_t>(rows), distance_slices};
    const std::uint32_t limit = device.physical().getProperties().limits.maxImageDimension3D;
    if (extent.width > limit || extent.height > limit)
        throw Error("upload", "the distance map", "it is larger than the " + std::to_string(limit) + " voxels " + device.info().name + " takes",
                    "choose a technique that does without");
    return gpu::make_volume(device, vk::Format::eR16Sfloat, extent, 2, [&](int slice, int y, std::byte* out) {
        for (std::uint32_t x = 0; x < extent.width; ++x) {
            const std::uint16_t voxel = map.empty() ? std::uint16_t{0} : gpu::to_half(map(static_cast<int>(x), slice * rows + y));
            std::memcpy(out + 2 * x, &voxel, 2);
        }
    });
}

// Values are whole numbers of 1/255, a layer a quadrant (maps/cell_cone.h). A missing map is one cell under a closed roof.
gpu::Image cell_cone_texture(const gpu::Device& device, const ImageF& map) {
    const ImageF closed(1, cell_cone_quadrants, 4, 1.0f);
    const ImageF& image = map.empty() ? closed : map;
    const int rows = image.height / cell_cone_quadrants;
    const auto limit = static_cast<int>(device.physical().getProperties().limits.maxImageDimension2D);
    if (image.width > limit || rows > limit)
        throw Error("upload", "the cell_cone map", "it is larger than the " + std::to_string(limit) + " texels " + device.info().name + " takes",
                    "scale the material down");
    return gpu::make_texture(
        device, vk::Format::eR8G8B8A8Unorm, {static_cast<std::uint32_t>(image.width), static_cast<std::uint32_t>(rows)}, 1, 4,
        [&](int, int row, std::byte* out) {
            const float* from = image.at(0, row);
            for (int i = 0; i < 4 * image.width; ++i) {
                const auto texel = static_cast<std::uint8_t>(from[i] * 255.0f + 0.5f);
                std::memcpy(out + i, &texel, 1);
            }
        },
        cell_cone_quadrants);
}

struct Bound {
    gpu::Image image;
    vk::Sampler sampler;
};

// A map as its accessor expects it (shaders/hosts/heightfield/maps.glsl); one texel in its place where the set lacks it.
Bound bound(const gpu::Device& device, const FamilyLayout& layout, Map map, const MapSet& maps) {
    using F = vk::Format;
    const auto flat = [&](F format, const ImageF& image, std::initializer_list<float> fallback, const char* name) {
        return image.empty() ? plain_texture(device, format, one_texel<float>(fallback), name) : single_texture(device, format, image, name);
    };
    switch (map) {
        case Map::height: return {flat(F::eR32Sfloat, maps.height.texels, {0}, "height"), *layout.height_sampler};
        case Map::normal:
            return {normal_texture(device, maps.normal.empty() ? one_texel<float>({0, 0, 1}) : maps.normal), *layout.trilinear_sampler};
        case Map::colour:  // 188 is half the light, encoded
            return {plain_texture(device, F::eR8G8B8A8Srgb, maps.colour.empty() ? one_texel<std::uint8_t>({188, 188, 188, 255}) : maps.colour, "colour"),
                    *layout.trilinear_sampler};
        case Map::max_pyramid:
            return {plain_texture(device, F::eR32Sfloat, maps.max_pyramid.levels.empty() ? one_texel<float>({1}) : maps.max_pyramid.levels, "max_pyramid"),
                    *layout.nearest_sampler};
        case Map::horizon: return {horizon_texture(device, maps.horizon), *layout.height_sampler};
        case Map::cone: return {flat(F::eR32G32Sfloat, maps.cone, {0, 0}, "cone"), *layout.height_sampler};
        case Map::conservative_cone:
            return {flat(F::eR32G32Sfloat, maps.conservative_cone, {0, 0}, "conservative_cone"), *layout.height_sampler};
        case Map::relaxed_cone: return {flat(F::eR32G32Sfloat, maps.relaxed_cone, {0, 0}, "relaxed_cone"), *layout.height_sampler};
        case Map::robust_cone: return {flat(F::eR32G32Sfloat, maps.robust_cone, {0, 0}, "robust_cone"), *layout.nearest_sampler};
        case Map::distance: return {distance_texture(device, maps.distance), *layout.volume_sampler};
        case Map::cell_cone:
            return {cell_cone_texture(device, maps.cell_cone), *layout.nearest_sampler};
    }
    return {};
}

MapFlags maps_there(const MapSet& maps) {
    MapFlags there;
    there[index_of(Map::height)] = !maps.height.empty();
    there[index_of(Map::normal)] = !maps.normal.empty();
    there[index_of(Map::colour)] = !maps.colour.empty();
    there[index_of(Map::max_pyramid)] = !maps.max_pyramid.levels.empty();
    there[index_of(Map::cone)] = !maps.cone.empty();
    there[index_of(Map::conservative_cone)] = !maps.conservative_cone.empty();
    there[index_of(Map::relaxed_cone)] = !maps.relaxed_cone.empty();
    there[index_of(Map::robust_cone)] = !maps.robust_cone.empty();
    there[index_of(Map::horizon)] = !maps.horizon.empty();
    there[index_of(Map::distance)] = !maps.distance.empty();
    there[index_of(Map::cell_cone)] = !maps.cell_cone.empty();
    return there;
}

}  // namespace

GpuMaterial::GpuMaterial(const gpu::Device& device, const FamilyLayout& layout, const MapSet& maps, float height_scale,
                         float zero_level)
    : height_scale_(height_scale), zero_level_(zero_level), has_(maps_there(maps)) {
    set_ = make_descriptor_set(device, layout.maps, {{vk::DescriptorType::eCombinedImageSampler, map_count}});
    vk::DescriptorImageInfo infos[map_count];
    vk::WriteDescriptorSet writes[map_count];
    for (const Map map : every_map) {
        const std::size_t i = index_of(map);
        auto [image, sampler] = bound(device, layout, map, maps);
        images_[i] = std::move(image);
        infos[i] = {.sampler = sampler, .imageView = *images_[i].view, .imageLayout = vk::ImageLayout::eShaderReadOnlyOptimal};
        writes[i] = {.dstSet = set_.handle,
                     .dstBinding = static_cast<std::uint32_t>(i),
                     .descriptorCount = 1,
                     .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                     .pImageInfo = &infos[i]};
    }
    device.handle().updateDescriptorSets(writes, {});
}

}  // namespace relievo
