// Measures how well texels of receivers follow weights of lamps when each keeps only some lamps: a room of
// eight lamps over 20 m, by each rule.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "runtime/pack/receivers/receiver_light.h"
#include "tests/bench/aims.h"
#include "tests/bench/lights/receiver_rules.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <random>

namespace
{

using namespace hearth;

constexpr size_t kLamps = 8;
constexpr Float3 kRoom{20, 10, 3}; ///< metres
constexpr float kAlbedo = 0.5f;
constexpr uint32_t kRooms = 3; ///< with other lamps each

struct Lamp
{
    Float3 place, color;
};

/// Lamps of two rows below the ceiling, of unequal light and colour.
std::array<Lamp, kLamps> hangLamps(uint32_t seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0, 1);
    std::array<Lamp, kLamps> lamps;
    for (size_t i = 0; i < kLamps; ++i)
    {
        const auto column = static_cast<float>(i % 4), row = static_cast<float>(i / 4);
        lamps[i].place = {2 + 5 * column + unit(random), 2 + 5 * row + unit(random),
                          2.2f + 0.5f * unit(random)};
        lamps[i].color =
            Float3{1, 0.6f + 0.4f * unit(random), 0.3f + 0.7f * unit(random)} * (5 + 10 * unit(random));
    }
    return lamps;
}

/// Wall, floor or ceiling: texels of the rectangle between `corner`, `corner` + `along` and `corner` + `up`.
struct Face
{
    Float3 corner, along, up, normal;
};

std::array<Face, 6> roomFaces()
{
    const auto [x, y, z] = kRoom;
    return {{{{0, 0, 0}, {x, 0, 0}, {0, y, 0}, {0, 0, 1}},
             {{0, 0, z}, {x, 0, 0}, {0, y, 0}, {0, 0, -1}},
             {{0, 0, 0}, {x, 0, 0}, {0, 0, z}, {0, 1, 0}},
             {{0, y, 0}, {x, 0, 0}, {0, 0, z}, {0, -1, 0}},
             {{0, 0, 0}, {0, y, 0}, {0, 0, z}, {1, 0, 0}},
             {{x, 0, 0}, {0, y, 0}, {0, 0, z}, {-1, 0, 0}}}};
}

/// Return the irradiance of a lamp, a small disc that shines downwards: its own light by I cos cos / d^2, and
/// the light that the room gives back, which falls with the distance as that of a ball of two metres.
Float3 irradiance(const Lamp& lamp, Float3 place, Float3 normal)
{
    const Float3 way = lamp.place - place;
    const float distance2 = std::max(dot(way, way), 1e-4f);
    const float direct = std::max(dot(way, normal), 0.0f) * std::max(way.z, 0.0f) / (distance2 * distance2);
    const float given_back = kAlbedo / (1 - kAlbedo) * 0.25f / (4 + distance2);
    return lamp.color * (direct + given_back);
}

/// The faces of the room in an atlas, one above the other, two rows apart.
class RoomAtlas
{
public:
    RoomAtlas(float texels_per_metre, uint32_t seed)
    {
        for (const Face& face : roomFaces())
        {
            const auto columns = static_cast<uint32_t>(length(face.along) * texels_per_metre);
            const auto rows = static_cast<uint32_t>(length(face.up) * texels_per_metre);
            atlas_.rects.push_back(
                {static_cast<uint32_t>(atlas_.rects.size()), 0, atlas_.height, columns, rows, 0});
            atlas_.width = std::max(atlas_.width, columns);
            atlas_.height += rows + 2;
        }
        for (uint32_t i = 0; i < kLamps; ++i)
            atlas_.lamps.push_back({static_cast<uint32_t>(formats::ReceiverLampKind::light), i});
        atlas_.valid.resize(size_t{atlas_.width} * atlas_.height);
        atlas_.light.resize(atlas_.valid.size() * kLamps);
        const std::array<Lamp, kLamps> hung = hangLamps(seed);
        const std::array<Face, 6> faces = roomFaces();
        for (size_t i = 0; i < faces.size(); ++i)
            lightFace(faces[i], atlas_.rects[i], hung);
    }

    const bench::LampAtlas& atlas() const { return atlas_; }

private:
    void lightFace(const Face& face, const formats::ReceiverRectRecord& rect, std::span<const Lamp> hung)
    {
        for (uint32_t y = 0; y < rect.height; ++y)
            for (uint32_t x = 0; x < rect.width; ++x)
            {
                const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(rect.width);
                const float v = (static_cast<float>(y) + 0.5f) / static_cast<float>(rect.height);
                const Float3 place = face.corner + face.along * u + face.up * v;
                const uint32_t texel = (rect.y + y) * atlas_.width + rect.x + x;
                atlas_.valid[texel] = 1;
                for (size_t lamp = 0; lamp < kLamps; ++lamp)
                    atlas_.light[texel * kLamps + lamp] = irradiance(hung[lamp], place, face.normal);
                if (x > 0)
                    atlas_.neighbours.push_back({texel - 1, texel});
                if (y > 0)
                    atlas_.neighbours.push_back({texel - atlas_.width, texel});
            }
    }

    bench::LampAtlas atlas_;
};

/// Measure how long an update of all texels takes, ms.
double timeUpdate(const bench::LampAtlas& atlas)
{
    const receivers::Atlas packed = receivers::packAtlas(atlas.baked(), {});
    std::vector<uint32_t> texels(atlas.valid.size());
    const bench::LampWeights ones(kLamps, {1, 1, 1});
    double best = 1e9;
    for (int i = 0; i < 5; ++i)
    {
        const auto start = std::chrono::steady_clock::now();
        pack::updateReceivers(packed.tables(), ones, 15, texels);
        const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
        best = std::min(best, took.count());
    }
    return best;
}

/// Measure all rules in a room, and record the figures of the one that ships.
void measureRoom(const bench::LampAtlas& atlas, size_t draw_count, bench::Judgement& judgement)
{
    std::printf("%zu texels, %zu lamps over %g m\n", atlas.texelCount(), kLamps, double{kRoom.x});
    const bench::RuleFigures chosen = bench::compareRules(atlas, bench::drawWeights(atlas, draw_count));
    std::printf("update of all texels by one thread: %.1f ms\n", timeUpdate(atlas));
    judgement.record("rms of all on", chosen.all_on.rms());
    judgement.record("rms of random weights", chosen.random.rms());
    judgement.record("jump between neighbouring texels", std::max(chosen.all_on.jump, chosen.random.jump));
    judgement.record("records of 16 bytes a texel", chosen.bytes / 16);
}

} // namespace

int main(int argc, char** argv)
{
    cli::CommandLine app("Measures the rules by which texels of receivers keep lamps.");
    uint32_t texels_per_metre = 40, draw_count = 8;
    app.addOption("--texels", texels_per_metre, "texels a metre").range(4u, 100u);
    app.addOption("--weights", draw_count, "draws of random weights").range(1u, 64u);
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    bench::Judgement judgement("receivers");
    for (uint32_t seed = 1; seed <= kRooms; ++seed)
        measureRoom(RoomAtlas(static_cast<float>(texels_per_metre), seed).atlas(), draw_count, judgement);
    return judgement.finish();
}
