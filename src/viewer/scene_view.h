// The picture of the window: a technique on a stage, drawn by the passes of render/, with the reference beside it.
#pragma once

#include "gpu/stopwatch.h"
#include "pipeline/map_set_bake.h"
#include "render/heightfield_pass.h"
#include "viewer/controls.h"

#include <optional>

namespace relievo {

class SceneView {
public:
    // `format`: of the canvas, 8 bits without conversion.
    SceneView(const gpu::Device& device, vk::Format format);

    // The maps, uploaded anew. Nothing may be drawing.
    void set_material(const BakedMaps& baked);
    // Of the search alone; the normals stay those of the maps.
    void set_height_scale(float height_scale);

    // Where in a canvas of which size the picture stands. Nothing may be drawing.
    void set_size(vk::Extent2D canvas, vk::Rect2D picture);
    const gpu::Image& canvas() const { return canvas_; }
    vk::Rect2D picture() const { return area_; }

    // An encoded picture of the picture's size, shown right of the divider.
    void set_reference(const Image8& reference);
    bool has_reference() const { return has_reference_; }
    void drop_reference() { has_reference_ = false; }

    // Mean fetches of the search over the pixels that meet the base, from a sixteenth of them. Draws and waits.
    double mean_fetches(const Controls& controls);

    // Makes the numbers and the program of the next frame ready. Nothing may be drawing.
    void prepare(const Controls& controls);
    // Draws the picture and, from `divider_px` on (in pixels of the picture), the reference. The canvas ends as colour-attachment.
    void record(const vk::raii::CommandBuffer& commands, const Controls& controls, std::optional<std::uint32_t> divider_px);
    // Of the technique's pass in the last frame, once that is drawn.
    double technique_ms() const { return stopwatch_.elapsed_ms(); }

    // The canvas as it was shown last; it is in the layout transfer-source.
    Image8 read_canvas() const;

private:
    HeightFieldPass::Draw draw(const Controls& controls, const FragmentHost& host) const;

    const gpu::Device& device_;
    HeightFieldPass pass_;
    SceneBinding scene_;
    gpu::Stopwatch stopwatch_;
    FragmentHost shade_host_;
    FragmentHost record_host_;
    vk::Format format_;
    std::optional<GpuMaterial> material_;
    Vec3f background_;
    gpu::Image canvas_;
    gpu::Image technique_;
    vk::Rect2D area_;
    gpu::Buffer reference_;
    bool has_reference_ = false;
    TargetSet probe_;
};

}  // namespace relievo
