// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/scene/occlusion_image.h"

#include "cook/visibility/scene/level_meshes.h"
#include "formats/base/assert.h"
#include "formats/pack/instance_meshes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hearth::visibility
{

using namespace formats;

namespace
{

constexpr uint32_t kSamplesPerAxis = 2; ///< samples per pixel along each axis

/// Tests of each sample against triangles, in the mean, after which the rest of the scene is not drawn.
constexpr uint64_t kMaxTests = 256;

constexpr float kMargin = 1.04f; ///< size of the image, relative to the objects in it

constexpr float kBackground = 0.1f;

/// Vertex in image space: x to the right and y down in samples, z away from the viewer; and its occlusion.
struct ProjectedVertex
{
    float x, y, z, occlusion;
};

class Rasterizer
{
public:
    Rasterizer(uint32_t width, uint32_t height)
        : width_(width * kSamplesPerAxis),
          height_(height * kSamplesPerAxis),
          depths_(size_t{width_} * height_, std::numeric_limits<float>::infinity()),
          values_(depths_.size(), kBackground)
    {
    }

    /// Choose the projection such that the image contains the whole box.
    void fit(const Box3& box)
    {
        Box3 seen;
        for (int corner = 0; corner < 8; ++corner)
            seen.add(toViewSpace({(corner & 1) != 0 ? box.max.x : box.min.x,
                                  (corner & 2) != 0 ? box.max.y : box.min.y,
                                  (corner & 4) != 0 ? box.max.z : box.min.z}));
        middle_ = (seen.min + seen.max) * 0.5f;
        const Float3 size = (seen.max - seen.min) * kMargin;
        const float needed =
            std::max(size.x / static_cast<float>(width_), size.y / static_cast<float>(height_));
        samples_per_metre_ = needed > 0 ? 1 / needed : 0;
    }

    ProjectedVertex project(Float3 world, float occlusion) const
    {
        const Float3 p = toViewSpace(world) - middle_;
        return {static_cast<float>(width_) / 2 + p.x * samples_per_metre_,
                static_cast<float>(height_) / 2 - p.y * samples_per_metre_, -p.z, occlusion};
    }

    void draw(const ProjectedVertex& a, const ProjectedVertex& b, const ProjectedVertex& c)
    {
        const float area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
        if (!(std::abs(area) > 0))
            return;
        const auto [left, right] = range(a.x, b.x, c.x, width_);
        const auto [top, bottom] = range(a.y, b.y, c.y, height_);
        tests_ += uint64_t{right - left} * (bottom - top);
        if (tests_ > kMaxTests * depths_.size())
            return;
        for (uint32_t row = top; row < bottom; ++row)
            for (uint32_t column = left; column < right; ++column)
            {
                const float x = static_cast<float>(column) + 0.5f, y = static_cast<float>(row) + 0.5f;
                const float v = ((b.x - a.x) * (y - a.y) - (x - a.x) * (b.y - a.y)) / area;
                const float u = ((x - a.x) * (c.y - a.y) - (c.x - a.x) * (y - a.y)) / area;
                if (u < 0 || v < 0 || u + v > 1)
                    continue;
                const auto between = [&](float at_a, float at_b, float at_c)
                { return at_a + u * (at_b - at_a) + v * (at_c - at_a); };
                const float depth = between(a.z, b.z, c.z);
                const size_t sample = size_t{row} * width_ + column;
                if (depth >= depths_[sample])
                    continue;
                depths_[sample] = depth;
                values_[sample] = between(a.occlusion, b.occlusion, c.occlusion);
            }
    }

    GreyImage image() const
    {
        GreyImage image{width_ / kSamplesPerAxis, height_ / kSamplesPerAxis, {}};
        for (uint32_t y = 0; y < image.height; ++y)
            for (uint32_t x = 0; x < image.width; ++x)
            {
                float sum = 0;
                for (uint32_t i = 0; i < kSamplesPerAxis * kSamplesPerAxis; ++i)
                    sum += values_[size_t{y * kSamplesPerAxis + i / kSamplesPerAxis} * width_ +
                                   x * kSamplesPerAxis + i % kSamplesPerAxis];
                const float mean = std::clamp(sum / (kSamplesPerAxis * kSamplesPerAxis), 0.0f, 1.0f);
                image.texels.push_back(static_cast<uint8_t>(std::lround(255 * mean)));
            }
        return image;
    }

private:
    /// Rotate to axes that point right, up, and towards the viewer, who stands in front (+z), to the right
    /// and above.
    static Float3 toViewSpace(Float3 p)
    {
        constexpr float kRight = 0.6f, kFront = 0.8f;    // direction to the viewer, seen from above
        constexpr float kUp = 0.5f, kLevel = 0.8660254f; // 30 degrees
        const float towards = kRight * p.x + kFront * p.z;
        return {kFront * p.x - kRight * p.z, kLevel * p.y - kUp * towards, kUp * p.y + kLevel * towards};
    }

    /// Return the range of samples that a triangle with these three coordinates can cover.
    static std::pair<uint32_t, uint32_t> range(float a, float b, float c, uint32_t size)
    {
        const auto clamped = [&](float x)
        { return static_cast<uint32_t>(std::clamp(x, 0.0f, static_cast<float>(size))); };
        return {clamped(std::floor(std::min({a, b, c}))), clamped(std::ceil(std::max({a, b, c})))};
    }

    uint32_t width_, height_; ///< in samples
    Float3 middle_;
    float samples_per_metre_ = 0;
    uint64_t tests_ = 0; ///< of samples against triangles
    std::vector<float> depths_;
    std::vector<float> values_;
};

bool isDrawn(const PackView& baked, uint32_t mesh)
{
    return mesh < baked.meshes().size() && baked.meshes()[mesh].clusters.count > 0 &&
           (baked.meshes()[mesh].attributes & kVertexVisibility) != 0;
}

/// Decode the ambient occlusion of each vertex of LevelArrays.
std::vector<float> decodeOcclusion(const MeshPages& pages, const LevelArrays& level)
{
    std::vector<float> occlusion;
    for (const LevelArrays::Part& part : level.parts)
    {
        const ClusterGeometry geometry = pages.cluster(part.cluster);
        for (uint32_t v = 0; v < geometry.vertexCount(); ++v)
            occlusion.push_back(shared::decodeVisibilityInFrame(geometry.visibilityCode(v)).m1.z /
                                shared::kVisibilityPi);
    }
    return occlusion;
}

} // namespace

Result<GreyImage> renderOcclusion(const PackView& scene, const PackView& baked, uint32_t width,
                                  uint32_t height)
{
    HEARTH_ASSIGN_OR_RETURN(const std::vector<uint32_t> meshes, readInstanceMeshes(scene, baked));
    Box3 box;
    for (uint32_t i = 0; i < meshes.size(); ++i)
    {
        if (!isDrawn(baked, meshes[i]))
            continue;
        const InstanceRecord& instance = scene.instances()[i];
        const MeshRecord& mesh = baked.meshes()[meshes[i]];
        for (int corner = 0; corner < 8; ++corner)
            box.add(transformPoint(instance.world_from_object,
                                   {(corner & 1) != 0 ? mesh.box_max.x : mesh.box_min.x,
                                    (corner & 2) != 0 ? mesh.box_max.y : mesh.box_min.y,
                                    (corner & 4) != 0 ? mesh.box_max.z : mesh.box_min.z}));
    }
    Rasterizer raster(width, height);
    if (!box.empty())
        raster.fit(box);
    for (uint32_t mesh = 0; mesh < baked.meshes().size(); ++mesh)
    {
        if (!isDrawn(baked, mesh))
            continue;
        HEARTH_ASSIGN_OR_RETURN(const MeshPages pages, MeshPages::read(baked, mesh));
        const LevelArrays finest = extractLevel(pages, 0);
        const std::vector<float> occlusion = decodeOcclusion(pages, finest);
        std::vector<ProjectedVertex> seen(finest.positions.size());
        for (uint32_t i = 0; i < meshes.size(); ++i)
        {
            if (meshes[i] != mesh)
                continue;
            const InstanceRecord& instance = scene.instances()[i];
            for (size_t v = 0; v < seen.size(); ++v)
                seen[v] = raster.project(transformPoint(instance.world_from_object, finest.positions[v]),
                                         occlusion[v]);
            for (size_t t = 0; t < finest.indices.size(); t += 3)
                raster.draw(seen[finest.indices[t]], seen[finest.indices[t + 1]],
                            seen[finest.indices[t + 2]]);
        }
    }
    return raster.image();
}

} // namespace hearth::visibility
