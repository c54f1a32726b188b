// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/frame/frame.h"

#include "formats/base/assert.h"
#include "formats/codecs/cluster_bounds.h"
#include "formats/gpu_shared/occlusion.h"
#include "runtime/frame/lod_curve.h"

namespace hearth::shared
{

namespace
{

Float4 row(Float3 a, float w = 0)
{
    return {a.x, a.y, a.z, w};
}

/// Return the right vector of a camera, or any unit vector perpendicular to `forward` for cameras that look
/// along their up vector.
Float3 rightVector(Float3 forward, Float3 up)
{
    const Float3 right = cross(forward, up);
    if (length(right) > 1e-4f * length(up))
        return right / length(right);
    const Float3 other = std::abs(forward.x) < 0.5f ? Float3{1, 0, 0} : Float3{0, 0, 1};
    return normalizeOr(cross(forward, other), {1, 0, 0});
}

/// Set the projection of an orthographic view.
/// x, y, w  unit vectors to the right of the image, up, and along the view
void setOrthographic(FrameView& view, const Camera& camera, Float3 x, Float3 y, Float3 w)
{
    HEARTH_ASSERT(camera.z_far > camera.z_near);
    const float half_width = camera.half_height * view.width / view.height;
    const Float3 right = x / half_width;
    const Float3 down = y / -camera.half_height; // Vulkan's clip space has y down
    const auto side = [](Float3 normal, float shift)
    { return row(normal, 1 + shift + (1 + std::abs(shift)) * kRoundingSlack); };
    view.clip_x = row(right, camera.shift.x);
    view.clip_y = row(down, -camera.shift.y);
    view.clip_w = row(w, camera.z_far);
    view.planes[0] = side(right, camera.shift.x);
    view.planes[1] = side(right * -1.0f, -camera.shift.x);
    view.planes[2] = side(down, -camera.shift.y);
    view.planes[3] = side(down * -1.0f, camera.shift.y);
    view.lod_scale = 0.5f * view.height / camera.half_height;
    view.corner_cosine = 1;
    view.depth_scale = 1 / (camera.z_far - camera.z_near);
}

} // namespace

FrameView makeFrameView(const Camera& camera, uint32_t width, uint32_t height, float error_pixels,
                        uint32_t instance_count, uint32_t flags)
{
    const Float3 forward = normalizeOr(camera.target - camera.position, {0, 0, -1});
    const Float3 right = rightVector(forward, camera.up);
    const Float3 up = cross(right, forward);
    const float focal = 1.0f / std::tan(0.5f * camera.y_fov_rad);
    const float aspect = static_cast<float>(width) / static_cast<float>(height);
    const Float3 w = forward;
    const Float3 x = right * (focal / aspect) + w * camera.shift.x;
    const Float3 y = (up * focal + w * camera.shift.y) * -1.0f; // Vulkan's clip space has y down

    FrameView view{};
    view.clip_x = row(x);
    view.clip_y = row(y);
    view.clip_w = row(w);
    view.planes[0] = row(w + x);
    view.planes[1] = row(w - x);
    view.planes[2] = row(w + y);
    view.planes[3] = row(w - y);
    view.planes[4] = row(w, -camera.z_near);
    view.eye = camera.position;
    view.z_near = camera.z_near;
    view.lod_scale = 0.5f * static_cast<float>(height) * focal;
    constexpr float kRounded = 0.999f;
    const float corner_x = (1 + std::abs(camera.shift.x)) * aspect / focal;
    const float corner_y = (1 + std::abs(camera.shift.y)) / focal;
    view.corner_cosine = kRounded / std::sqrt(1 + corner_x * corner_x + corner_y * corner_y);
    // an error of exactly 0 never exceeds a threshold of 0: only a negative threshold refines planes to their
    // source triangles
    view.threshold = error_pixels > 0 ? error_pixels : -1.0f;
    view.flags = flags;
    view.instance_count = instance_count;
    view.width = static_cast<float>(width);
    view.height = static_cast<float>(height);
    if (camera.half_height > 0)
        setOrthographic(view, camera, right, up, forward);
    const Status plain = setLodCurve(view, {});
    HEARTH_ASSERT(plain.ok());
    return view;
}

OcclusionView makeOcclusionView(const FrameView& view)
{
    const auto width = static_cast<uint32_t>(view.width);
    const auto height = static_cast<uint32_t>(view.height);
    return {.clip_x = view.clip_x,
            .clip_y = view.clip_y,
            .clip_w = view.clip_w,
            .eye = view.eye,
            .z_near = view.z_near,
            .width = width,
            .height = height,
            .level_count = pyramidLevels(width, height),
            .depth_scale = view.depth_scale};
}

InstanceInverse makeInstanceInverse(const formats::InstanceRecord& instance)
{
    const auto& m = instance.world_from_object.m;
    const auto minor = [&](int r0, int c0, int r1, int c1)
    { return double{m[r0][c0]} * double{m[r1][c1]} - double{m[r0][c1]} * double{m[r1][c0]}; };
    const double cofactors[3][3] = {{minor(1, 1, 2, 2), -minor(1, 0, 2, 2), minor(1, 0, 2, 1)},
                                    {-minor(0, 1, 2, 2), minor(0, 0, 2, 2), -minor(0, 0, 2, 1)},
                                    {minor(0, 1, 1, 2), -minor(0, 0, 1, 2), minor(0, 0, 1, 1)}};
    const double determinant =
        m[0][0] * cofactors[0][0] + m[0][1] * cofactors[0][1] + m[0][2] * cofactors[0][2];

    InstanceInverse inverse{};
    Float4* rows[3] = {&inverse.object_from_world_x, &inverse.object_from_world_y,
                       &inverse.object_from_world_z};
    bool finite = true;
    for (int i = 0; i < 3; ++i)
    {
        *rows[i] = {static_cast<float>(cofactors[0][i] / determinant),
                    static_cast<float>(cofactors[1][i] / determinant),
                    static_cast<float>(cofactors[2][i] / determinant), 0};
        finite = finite && isFinite(row3(*rows[i]));
    }
    if (!finite)
        return InstanceInverse{};
    inverse.object_from_world_x.w = 1;
    return inverse;
}

std::vector<MeshBounds> makeMeshBounds(std::span<const formats::MeshRecord> meshes,
                                       std::span<const formats::ClusterRecord> clusters)
{
    std::vector<MeshBounds> bounds;
    bounds.reserve(meshes.size());
    for (const formats::MeshRecord& mesh : meshes)
    {
        Box3 box;
        for (const formats::ClusterRecord& cluster :
             clusters.subspan(mesh.clusters.first, mesh.clusters.count))
            box.add(formats::clusterBox(cluster, mesh.grid_step));
        bounds.push_back({box.min, mesh.grid_step, box.max, 0});
    }
    return bounds;
}

} // namespace hearth::shared
