// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/light/settled_light.h"

#include "cook/bricks/light/face_rays.h"
#include "cook/bricks/light/march_lanes.h"
#include "formats/base/assert.h"

#include <algorithm>
#include <tbb/parallel_for.h>

namespace hearth::bricks
{

using namespace shared;

namespace
{

/// Faces whose rays march side by side.
constexpr size_t kFacesAtOnce = 16;

/// Faces that one thread sums.
constexpr size_t kFacesPerSum = 4096;

/// Change of the light in one sweep, relative to all light, below which it has settled.
constexpr double kSettledChange = 1e-4;

/// Upper bound of the sweeps: after it less than a hundredth is missing at the largest albedo.
constexpr uint32_t kMaxSweeps = 90;

/// Light that one face gets from another: a factor of its radiance.
struct Term
{
    uint32_t face;
    float factor;
};

/// Equation of the faces first to first + count - 1:
///     radiance = constant + albedo * sum of (factor * radiance of its terms)
struct Block
{
    std::vector<Float3> constants; ///< of each face: emission, and what lights and sky add
    std::vector<Float3> albedos;
    std::vector<uint32_t> ends; ///< of each face's terms
    std::vector<Term> terms;
};

/// Call visit(face, share) for each face that a ray meets, with its share of the ray's light.
/// ray      in its first solid voxel
/// returns  share of what lies behind all faces. Sums as traceBrickLight does
template <typename Visit>
float forEachMetFace(const BrickScene& scene, BrickRay ray, const Visit& visit)
{
    float through = 1;
    while (ray.inside != 0)
    {
        const Brick& brick = scene.masks.bricks[ray.brick];
        const float opacity = brickOpacityAt(scene, brickVoxel(brick, ray.bit));
        if (const uint32_t face = brickFace(brick, ray.bit, ray.face); face != kNoFace)
            visit(face, through * opacity);
        through *= 1 - opacity;
        if (through < kMinBrickTransmittance)
            return 0;
        ray = brickMarch(scene.masks, brickSkipVoxel(scene.masks, ray));
    }
    return through;
}

/// Makes the equations of faces.
class EquationMaker
{
public:
    EquationMaker(const BrickView& bricks, const SceneLighting& lighting, uint32_t rays)
        : bricks_(bricks),
          lighting_(lighting),
          rays_(rays),
          table_(bricks.masks),
          places_(faceLocations(bricks.masks))
    {
    }

    Block make(size_t first, size_t end) const
    {
        Block block;
        for (size_t some = first; some < end; some += kFacesAtOnce)
            add(some, std::min(some + kFacesAtOnce, end), block);
        return block;
    }

private:
    void add(size_t first, size_t end, Block& block) const
    {
        std::vector<BrickStart> starts;
        std::vector<BrickRay> marched;
        for (size_t face = first; face < end; ++face)
        {
            starts.push_back(startFace(bricks_, scene(), places_[face], face));
            addFaceRays(scene(), places_[face], starts.back(), rays_, marched);
        }
        marchRays(table_, marched);
        for (size_t face = first; face < end; ++face)
            add(face, starts[face - first], std::span(marched).subspan((face - first) * rays_, rays_), block);
    }

    void add(size_t face, const BrickStart& start, std::span<const BrickRay> rays, Block& block) const
    {
        const Float3 albedo = decodeAlbedo(bricks_.albedo[face]);
        const float part = 1.0f / static_cast<float>(rays_);
        Float3 irradiance;
        if (start.is_interior == 0)
            for (const BrickRay& ray : rays)
            {
                const float through = forEachMetFace(scene(), ray,
                                                     [&](uint32_t met, float share) {
                                                         block.terms.push_back({met, share * part});
                                                     });
                if (through > 0)
                    irradiance += skyRadiance(lighting_.sky, ray.direction) * (through * part);
            }
        for (const Light& light : lighting_.lights)
            irradiance += brickDirect(scene(), start, light);
        block.constants.push_back(brickOutgoingRadiance(
            decodeRadiance(bricks_.emission[face]) * lighting_.exposure, albedo, irradiance));
        block.albedos.push_back(brickOutgoingRadiance({}, albedo, {1, 1, 1}));
        block.ends.push_back(static_cast<uint32_t>(block.terms.size()));
    }

    BrickScene scene() const { return {bricks_.masks, bricks_.opacity, {}}; }

    const BrickView& bricks_;
    const SceneLighting& lighting_;
    uint32_t rays_;
    MarchTable table_;
    std::vector<FaceLocation> places_;
};

std::vector<Block> makeEquations(const BrickView& bricks, const SceneLighting& lighting, uint32_t rays)
{
    const EquationMaker maker(bricks, lighting, rays);
    const size_t faces = bricks.albedo.size();
    std::vector<Block> blocks((faces + kFacesPerSum - 1) / kFacesPerSum);
    tbb::parallel_for(size_t{0}, blocks.size(),
                      [&](size_t i)
                      { blocks[i] = maker.make(i * kFacesPerSum, std::min((i + 1) * kFacesPerSum, faces)); });
    return blocks;
}

/// Light of faces summed over their colours, and how much of it a sweep has changed.
struct Change
{
    double light = 0, change = 0;
};

/// Sweep over a block's faces in place: they see each other's new light, and the other blocks' old light.
/// now  light of the block's faces
Change sweep(const Block& block, size_t first, std::span<const Float3> before, std::span<Float3> now)
{
    Change sum;
    size_t term = 0;
    for (size_t i = 0; i < now.size(); ++i)
    {
        Float3 irradiance;
        for (; term < block.ends[i]; ++term)
        {
            const auto [face, factor] = block.terms[term];
            const bool is_own = face >= first && face < first + now.size();
            irradiance += (is_own ? now[face - first] : before[face]) * factor;
        }
        const Float3 next = block.constants[i] + block.albedos[i] * irradiance;
        const Float3 change = next - now[i];
        sum.change += std::abs(change.x) + std::abs(change.y) + std::abs(change.z);
        sum.light += next.x + next.y + next.z;
        now[i] = next;
    }
    return sum;
}

} // namespace

SettledLight settleLight(const BrickView& bricks, const SceneLighting& lighting, uint32_t rays)
{
    HEARTH_ASSERT(rays > 0);
    const std::vector<Block> blocks = makeEquations(bricks, lighting, rays);
    std::vector<Float3> before(bricks.albedo.size()), now(before.size());
    std::vector<Change> changes(blocks.size());
    SettledLight settled;
    for (Change sum{0, 1}; settled.sweeps < kMaxSweeps && sum.change > kSettledChange * sum.light;)
    {
        tbb::parallel_for(size_t{0}, blocks.size(),
                          [&](size_t i)
                          {
                              const size_t first = i * kFacesPerSum;
                              changes[i] = sweep(blocks[i], first, before,
                                                 std::span(now).subspan(first, blocks[i].constants.size()));
                          });
        before = now;
        sum = {};
        for (const Change& change : changes)
            sum = {sum.light + change.light, sum.change + change.change};
        ++settled.sweeps;
    }
    settled.codes.reserve(now.size());
    for (const Float3 radiance : now)
        settled.codes.push_back(encodeRadiance(radiance));
    return settled;
}

} // namespace hearth::bricks
