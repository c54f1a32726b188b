// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/light/settled_light.h"

#include "cook/bricks/light/face_rays.h"
#include "cook/bricks/light/march_lanes.h"
#include "formats/base/assert.h"

#include <algorithm>
#include <array>
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

/// Lamps that are swept together: their light of a face is one and a half cache lines.
constexpr uint32_t kLampsAtOnce = 8;

/// Equation of the faces first to first + count - 1, for each lamp:
///     radiance = constant + albedo * sum of (factor * radiance of its terms)
struct Block
{
    std::vector<Float3> constants; ///< [faces][lamps]: emission, and what lights and sky add
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
    EquationMaker(const BrickView& bricks, const SceneLighting& lighting, const LampSources& sources,
                  uint32_t rays)
        : bricks_(bricks),
          lighting_(lighting),
          sources_(sources),
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
        std::vector<Float3> irradiances(sources_.count);
        if (start.is_interior == 0)
            for (const BrickRay& ray : rays)
            {
                const float through = forEachMetFace(scene(), ray,
                                                     [&](uint32_t met, float share) {
                                                         block.terms.push_back({met, share * part});
                                                     });
                if (through > 0)
                    irradiances[0] += skyRadiance(lighting_.sky, ray.direction) * (through * part);
            }
        for (size_t i = 0; i < lighting_.lights.size(); ++i)
            irradiances[sources_.lamps_of_lights[i]] += brickDirect(scene(), start, lighting_.lights[i]);
        const std::vector<Float3> emissions = splitEmission(face);
        for (uint32_t lamp = 0; lamp < sources_.count; ++lamp)
            block.constants.push_back(brickOutgoingRadiance(emissions[lamp], albedo, irradiances[lamp]));
        block.albedos.push_back(brickOutgoingRadiance({}, albedo, {1, 1, 1}));
        block.ends.push_back(static_cast<uint32_t>(block.terms.size()));
    }

    /// Return the emission of a face for each lamp.
    std::vector<Float3> splitEmission(size_t face) const
    {
        const Float3 all = decodeRadiance(bricks_.emission[face]) * lighting_.exposure;
        std::vector<Float3> emissions(sources_.count);
        emissions[0] = all;
        for (auto i = std::ranges::lower_bound(sources_.emissions, face, {}, &LampEmission::face);
             i != sources_.emissions.end() && i->face == face; ++i)
        {
            emissions[i->lamp] += all * i->share;
            const Float3 rest = emissions[0] - all * i->share;
            emissions[0] = {std::max(rest.x, 0.0f), std::max(rest.y, 0.0f), std::max(rest.z, 0.0f)};
        }
        return emissions;
    }

    BrickScene scene() const { return {bricks_.masks, bricks_.opacity, {}}; }

    const BrickView& bricks_;
    const SceneLighting& lighting_;
    const LampSources& sources_;
    uint32_t rays_;
    MarchTable table_;
    std::vector<FaceLocation> places_;
};

std::vector<Block> makeEquations(const BrickView& bricks, const SceneLighting& lighting,
                                 const LampSources& sources, uint32_t rays)
{
    HEARTH_ASSERT(rays > 0 && sources.count > 0);
    HEARTH_ASSERT(sources.lamps_of_lights.size() == lighting.lights.size());
    const EquationMaker maker(bricks, lighting, sources, rays);
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

/// Some lamps of all: their light in a sweep.
struct LampRange
{
    uint32_t first, count; ///< count at most kLampsAtOnce
    uint32_t of;           ///< number of all lamps
};

using Changes = std::array<Change, kLampsAtOnce>;

/// Sweep over a block's faces in place: they see each other's new light, and the other blocks' old light.
/// now  [faces][lamps.count]: light of the block's faces
Changes sweep(const Block& block, size_t first, const LampRange& lamps, std::span<const Float3> before,
              std::span<Float3> now)
{
    Changes sums;
    size_t term = 0;
    for (size_t i = 0; i < block.albedos.size(); ++i)
    {
        std::array<Float3, kLampsAtOnce> irradiances{};
        for (; term < block.ends[i]; ++term)
        {
            const auto [face, factor] = block.terms[term];
            const bool is_own = face >= first && face < first + block.albedos.size();
            const Float3* const met =
                is_own ? &now[(face - first) * lamps.count] : &before[size_t{face} * lamps.count];
            for (uint32_t lamp = 0; lamp < lamps.count; ++lamp)
                irradiances[lamp] += met[lamp] * factor;
        }
        for (uint32_t lamp = 0; lamp < lamps.count; ++lamp)
        {
            const Float3 next =
                block.constants[i * lamps.of + lamps.first + lamp] + block.albedos[i] * irradiances[lamp];
            Float3& old = now[i * lamps.count + lamp];
            const Float3 change = next - old;
            sums[lamp].change += std::abs(change.x) + std::abs(change.y) + std::abs(change.z);
            sums[lamp].light += next.x + next.y + next.z;
            old = next;
        }
    }
    return sums;
}

/// Return true if the light of no lamp changes any more, by the changes of all blocks.
bool hasSettled(std::span<const Changes> changes, uint32_t lamps)
{
    for (uint32_t lamp = 0; lamp < lamps; ++lamp)
    {
        Change sum;
        for (const Changes& change : changes)
            sum = {sum.light + change[lamp].light, sum.change + change[lamp].change};
        if (sum.change > kSettledChange * sum.light)
            return false;
    }
    return true;
}

struct Settled
{
    std::vector<Float3> light; ///< [faces][lamps of the range]
    uint32_t sweeps = 0;
};

Settled settle(std::span<const Block> blocks, size_t faces, const LampRange& lamps)
{
    Settled settled{.light = std::vector<Float3>(faces * lamps.count)};
    std::vector<Float3> before(settled.light.size());
    std::vector<Changes> changes(blocks.size());
    do
    {
        tbb::parallel_for(size_t{0}, blocks.size(),
                          [&](size_t i)
                          {
                              const size_t first = i * kFacesPerSum;
                              changes[i] = sweep(blocks[i], first, lamps, before,
                                                 std::span(settled.light).subspan(first * lamps.count));
                          });
        before = settled.light;
        ++settled.sweeps;
    } while (settled.sweeps < kMaxSweeps && !hasSettled(changes, lamps.count));
    return settled;
}

} // namespace

SettledLight settleLight(const BrickView& bricks, const SceneLighting& lighting, uint32_t rays)
{
    const LampSources all{
        .count = 1, .lamps_of_lights = std::vector<uint32_t>(lighting.lights.size()), .emissions = {}};
    const std::vector<Block> blocks = makeEquations(bricks, lighting, all, rays);
    const Settled settled = settle(blocks, bricks.albedo.size(), {0, 1, 1});
    SettledLight light{.codes = {}, .sweeps = settled.sweeps};
    light.codes.reserve(settled.light.size());
    for (const Float3 radiance : settled.light)
        light.codes.push_back(encodeRadiance(radiance));
    return light;
}

std::vector<Float3> settleLamps(const BrickView& bricks, const SceneLighting& lighting,
                                const LampSources& sources, uint32_t rays)
{
    const std::vector<Block> blocks = makeEquations(bricks, lighting, sources, rays);
    const size_t faces = bricks.albedo.size();
    std::vector<Float3> light(faces * sources.count);
    for (uint32_t first = 0; first < sources.count; first += kLampsAtOnce)
    {
        const LampRange range{first, std::min(kLampsAtOnce, sources.count - first), sources.count};
        const Settled settled = settle(blocks, faces, range);
        for (size_t face = 0; face < faces; ++face)
            std::copy_n(settled.light.begin() + static_cast<ptrdiff_t>(face * range.count), range.count,
                        light.begin() + static_cast<ptrdiff_t>(face * sources.count + first));
    }
    return light;
}

} // namespace hearth::bricks
