// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/light/face_lighting.h"

#include "cook/bricks/light/face_rays.h"
#include "formats/base/assert.h"

#include <algorithm>
#include <cmath>
#include <tbb/parallel_for.h>

namespace hearth::bricks
{

using namespace shared;

namespace
{

/// Approximate number of rays that march side by side, rounded to whole faces.
constexpr uint32_t kRaysAtOnce = 256;

} // namespace

FaceLighting::FaceLighting(const BrickView& bricks)
    : bricks_(bricks), table_(bricks.masks), places_(faceLocations(bricks.masks)), next_(places_.size())
{
    HEARTH_ASSERT(places_.size() == bricks.lighting.size());
    faces_.reserve(bricks.lighting.size());
    for (const uint32_t code : bricks.lighting)
        faces_.push_back({code, 0});
}

void FaceLighting::light(const SceneLighting& lighting, const FrameBudget& share)
{
    HEARTH_ASSERT(share.period > 0 && share.rays > 0);
    const std::span<const Brick> bricks = bricks_.masks.bricks;
    const auto brick_count = static_cast<uint32_t>(bricks.size());
    const auto firstFace = [&](uint32_t brick)
    { return brick < brick_count ? size_t{bricks[brick].first_face} : faces_.size(); };
    const size_t first = firstFace(brickSliceBegin(brick_count, frame_, share.period));
    const size_t end = firstFace(brickSliceEnd(brick_count, frame_, share.period));
    ++frame_;
    const size_t at_once = std::max(1u, kRaysAtOnce / share.rays);
    tbb::parallel_for(size_t{0}, (end - first + at_once - 1) / at_once,
                      [&](size_t i)
                      {
                          const size_t some = first + i * at_once;
                          light(lighting, share.rays, some, std::min(some + at_once, end));
                      });
    std::copy(next_.begin() + static_cast<ptrdiff_t>(first), next_.begin() + static_cast<ptrdiff_t>(end),
              faces_.begin() + static_cast<ptrdiff_t>(first));
}

void FaceLighting::sweep(const SceneLighting& lighting, uint32_t rays, uint32_t sweeps)
{
    for (uint32_t i = 0; i < sweeps; ++i)
        light(lighting, {.period = 1, .rays = rays});
}

std::vector<uint32_t> FaceLighting::codes() const
{
    std::vector<uint32_t> codes;
    codes.reserve(faces_.size());
    for (const BrickLight& face : faces_)
        codes.push_back(face.code);
    return codes;
}

void FaceLighting::light(const SceneLighting& lighting, uint32_t rays, size_t first, size_t end)
{
    const BrickScene scene = this->scene();
    std::vector<BrickStart> starts;
    std::vector<BrickRay> marched;
    marched.reserve((end - first) * rays);
    for (size_t face = first; face < end; ++face)
    {
        starts.push_back(startFace(bricks_, scene, places_[face], face));
        addFaceRays(scene, places_[face], starts.back(), rays, marched);
    }
    marchRays(table_, marched);
    for (size_t face = first; face < end; ++face)
    {
        const BrickStart& start = starts[face - first];
        // same sum as brickGather
        Float3 sum;
        for (size_t i = 0; i < rays; ++i)
            sum += traceBrickLight(scene, lighting.sky, marched[(face - first) * rays + i]).radiance;
        Float3 irradiance = start.is_interior != 0 ? Float3{} : sum * (1.0f / static_cast<float>(rays));
        for (const Light& light : lighting.lights)
            irradiance += brickDirect(scene, start, light);
        next_[face] =
            encodeBrickLight(brickOutgoingRadiance(decodeRadiance(bricks_.emission[face]) * lighting.exposure,
                                                   decodeAlbedo(bricks_.albedo[face]), irradiance));
    }
}

uint32_t sweepsToDecay(float max_albedo, float share)
{
    const double kept = double{std::min(max_albedo, kMaxBrickAlbedo)} * 1.0001;
    return std::max(1u, static_cast<uint32_t>(std::ceil(std::log(double{share}) / std::log(kept))));
}

} // namespace hearth::bricks
