// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/bench/cut_figures.h"

#include "tests/reference/culling/depth_pyramid.h"
#include "tests/reference/flip.h"

#include <algorithm>
#include <bit>

namespace hearth::bench
{

using reference::DrawnCluster;

namespace
{

constexpr uint32_t kReferenceSamples = 4; // along each side of a pixel

/// Draws clusters of a scene into images of one view.
class ClusterPainter
{
public:
    ClusterPainter(const CutScene& scene, const shared::FrameView& view) : scene_(scene), view_(view) {}

    shared::Instance instance(const DrawnCluster& which) const
    {
        return std::bit_cast<shared::Instance>(scene_.view().instances()[which.instance]);
    }

    /// Draw a cluster, with ids slot << 7 | triangle; return the number of triangles that face the eye.
    size_t draw(SampleImage& image, const DrawnCluster& which, size_t slot) const
    {
        const formats::InstanceRecord& record = scene_.view().instances()[which.instance];
        const shared::InstanceInverse inverse = shared::makeInstanceInverse(record);
        const ClusterMesh& cluster = scene_.cluster(which.cluster);
        std::vector<Float3> corners, normals;
        for (size_t v = 0; v < cluster.positions.size(); ++v)
        {
            corners.push_back(shared::toEyeRelative(instance(which), view_.eye, cluster.positions[v]));
            const Float3 n = cluster.normals[v]; // normals move by the transposed inverse
            normals.push_back(normalizeOr(shared::row3(inverse.object_from_world_x) * n.x +
                                              shared::row3(inverse.object_from_world_y) * n.y +
                                              shared::row3(inverse.object_from_world_z) * n.z,
                                          {0, 1, 0}));
        }
        size_t facing = 0;
        for (size_t t = 0; t < cluster.triangles.size(); ++t)
        {
            const auto [a, b, c] = cluster.triangles[t];
            const bool faces =
                image.draw({{corners[a], corners[b], corners[c]}, {normals[a], normals[b], normals[c]}},
                           static_cast<uint32_t>(slot << shared::kTriangleBits | t));
            facing += faces ? 1 : 0;
        }
        return facing;
    }

    SampleImage drawAll(std::span<const DrawnCluster> clusters, uint32_t samples_across) const
    {
        SampleImage image(view_, samples_across);
        for (size_t slot = 0; slot < clusters.size(); ++slot)
            draw(image, clusters[slot], slot);
        return image;
    }

    /// True if the image is nearer than a cluster at all pixels of the rectangle around its vertices.
    bool isCovered(const SampleImage& image, const DrawnCluster& which) const
    {
        float left = view_.width, right = 0, top = view_.height, bottom = 0, depth = 0;
        for (const Float3 position : scene_.cluster(which.cluster).positions)
        {
            const Float4 clip =
                shared::clipPosition(view_, shared::toEyeRelative(instance(which), view_.eye, position));
            if (clip.w <= view_.z_near)
                return false;
            const float x = (clip.x / clip.w * 0.5f + 0.5f) * view_.width;
            const float y = (clip.y / clip.w * 0.5f + 0.5f) * view_.height;
            left = std::min(left, x);
            right = std::max(right, x);
            top = std::min(top, y);
            bottom = std::max(bottom, y);
            depth = std::max(depth, view_.z_near / clip.w);
        }
        const auto clamped = [](float at, float size)
        { return static_cast<size_t>(std::clamp(at, 0.0f, size - 1)); };
        const auto width = static_cast<size_t>(view_.width);
        for (size_t y = clamped(top, view_.height); y <= clamped(bottom, view_.height); ++y)
            for (size_t x = clamped(left, view_.width); x <= clamped(right, view_.width); ++x)
                if (image.depths()[y * width + x] <= depth)
                    return false;
        return true;
    }

private:
    const CutScene& scene_;
    const shared::FrameView& view_;
};

/// Return for each slot << 7 | triangle 1 if it is in the image.
std::vector<uint8_t> findSeen(const SampleImage& image, size_t slots)
{
    std::vector<uint8_t> seen(slots << shared::kTriangleBits);
    for (const uint32_t id : image.ids())
        if (id != SampleImage::kNothing)
            seen[id] = 1;
    return seen;
}

/// Count what is left after occlusion culling by the image's own depths.
CutFigures countDrawn(const CutScene& scene, const shared::FrameView& view,
                      std::span<const DrawnCluster> clusters, const SampleImage& image)
{
    const ClusterPainter painter(scene, view);
    const std::vector<uint8_t> seen = findSeen(image, clusters.size());
    const reference::Pyramid pyramid{shared::makeOcclusionView(view),
                                     reference::makePyramid(image.depths(), static_cast<uint32_t>(view.width),
                                                            static_cast<uint32_t>(view.height))};
    SampleImage scratch(view, 1);
    CutFigures figures;
    figures.pixels = static_cast<double>(image.ids().size()) -
                     static_cast<double>(std::ranges::count(image.ids(), SampleImage::kNothing));
    for (size_t slot = 0; slot < clusters.size(); ++slot)
    {
        const DrawnCluster& which = clusters[slot];
        const shared::Instance instance = painter.instance(which);
        const auto cluster = std::bit_cast<shared::Cluster>(scene.view().clusters()[which.cluster]);
        const float step = scene.view().meshes()[instance.mesh].grid_step;
        if (reference::isHidden(pyramid, instance, shared::clusterBoxMin(cluster, step),
                                shared::clusterBoxMax(cluster, step)))
            continue;
        const auto first = seen.begin() + static_cast<std::ptrdiff_t>(slot << shared::kTriangleBits);
        const auto seen_triangles = std::count(first, first + (1 << shared::kTriangleBits), 1);
        const size_t facing = painter.draw(scratch, which, slot);
        figures.clusters += 1;
        figures.facing_clusters += facing > 0 ? 1 : 0;
        figures.uncovered_clusters += painter.isCovered(image, which) ? 0 : 1;
        figures.triangles += static_cast<double>(scene.cluster(which.cluster).triangles.size());
        if (seen_triangles == 0)
            continue;
        figures.seen_clusters += 1;
        figures.seen_triangles += static_cast<double>(seen_triangles);
        figures.facing_triangles += static_cast<double>(facing);
    }
    return figures;
}

/// Return the sum of FLIP over the pixels that `covering` covers.
double sumFlip(const viewer::Image& expected, const viewer::Image& image, const SampleImage& covering)
{
    const reference::FlipMap map = reference::flip(expected, image);
    double sum = 0;
    for (size_t i = 0; i < map.error.size(); ++i)
        sum += covering.ids()[i] == SampleImage::kNothing ? 0 : double{map.error[i]};
    return sum;
}

} // namespace

void CutFigures::add(const CutFigures& other)
{
    clusters += other.clusters;
    facing_clusters += other.facing_clusters;
    uncovered_clusters += other.uncovered_clusters;
    seen_clusters += other.seen_clusters;
    triangles += other.triangles;
    facing_triangles += other.facing_triangles;
    seen_triangles += other.seen_triangles;
    pixels += other.pixels;
    flip += other.flip;
    flip_four += other.flip_four;
}

ViewMeter::ViewMeter(const CutScene& scene, const shared::FrameView& view)
    : scene_(scene),
      view_(view),
      reference_(ClusterPainter(scene, view)
                     .drawAll(chooseClusters(scene, view, {.threshold = -1}), kReferenceSamples)
                     .resolve())
{
}

Result<CutFigures> ViewMeter::measure(const CutRule& rule, const std::string& images) const
{
    const std::vector<DrawnCluster> clusters = chooseClusters(scene_, view_, rule);
    const ClusterPainter painter(scene_, view_);
    const SampleImage image = painter.drawAll(clusters, 1);
    const viewer::Image four = painter.drawAll(clusters, 2).resolve();
    CutFigures figures = countDrawn(scene_, view_, clusters, image);
    figures.flip = sumFlip(reference_, image.resolve(), image);
    figures.flip_four = sumFlip(reference_, four, image);
    if (!images.empty())
    {
        HEARTH_TRY(viewer::writePng(images + ".png", four));
        HEARTH_TRY(viewer::writePng(images + "-all.png", reference_));
    }
    return figures;
}

} // namespace hearth::bench
