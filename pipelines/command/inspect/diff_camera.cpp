// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/inspect/diff_camera.h"

#include "formats/base/math.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace hearth::command
{

namespace
{

constexpr float kFieldOfView_degrees = 34;
constexpr float kFieldOfView_rad = 0.593412F;
constexpr Float3 kViewDirection{0.55F, 0.42F, 0.8F};

void addInstances(const formats::PackView& pack, Box3& bounds)
{
    for (const formats::InstanceRecord& instance : pack.instances())
    {
        const formats::MeshRecord& mesh = pack.meshes()[instance.mesh];
        for (int corner = 0; corner < 8; ++corner)
            bounds.add(transformPoint(instance.world_from_object,
                                      {(corner & 1) != 0 ? mesh.box_max.x : mesh.box_min.x,
                                       (corner & 2) != 0 ? mesh.box_max.y : mesh.box_min.y,
                                       (corner & 4) != 0 ? mesh.box_max.z : mesh.box_min.z}));
    }
}

/// Parse "WIDTHxHEIGHT" and return width over height; 1 if it is invalid.
float parseAspectRatio(const std::string& size)
{
    unsigned width = 0;
    unsigned height = 0;
    const char* end = size.data() + size.size();
    const auto first = std::from_chars(size.data(), end, width);
    if (first.ec == std::errc() && first.ptr != end)
        std::from_chars(first.ptr + 1, end, height);
    return width > 0 && height > 0 ? static_cast<float>(width) / static_cast<float>(height) : 1;
}

} // namespace

std::string makeDiffCamera(const formats::PackView& a, const formats::PackView& b, const std::string& size)
{
    Box3 bounds;
    addInstances(a, bounds);
    addInstances(b, bounds);
    if (bounds.empty())
        bounds.add(Float3{});
    const Float3 target = bounds.center();
    // the bounding sphere touches the narrower pair of the view's sides
    const float radius = std::max(length(bounds.max - target), 1e-3F);
    const float tangent = std::tan(0.5F * kFieldOfView_rad) * std::min(1.0F, parseAspectRatio(size));
    const Float3 position =
        target + normalizeOr(kViewDirection, {0, 0, 1}) * (radius / std::sin(std::atan(tangent)));
    return fmt::format("{},{},{},{},{},{},{}", position.x, position.y, position.z, target.x, target.y,
                       target.z, kFieldOfView_degrees);
}

} // namespace hearth::command
