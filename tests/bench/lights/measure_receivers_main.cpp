// Measures how well texels of receivers follow weights of lamps when each keeps only some lamps: a room of
// eight lamps over 20 m, by each rule.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "cook/receivers/select/atlas.h"
#include "formats/texels/shared_exponent.h"
#include "runtime/pack/receivers/receiver_light.h"
#include "tests/bench/aims.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <random>
#include <string_view>

namespace
{

using namespace hearth;
using receivers::BakedLight;
using receivers::KeptLight;

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
struct Room
{
    Room(float texels_per_metre, uint32_t seed)
    {
        for (const Face& face : roomFaces())
        {
            const auto columns = static_cast<uint32_t>(length(face.along) * texels_per_metre);
            const auto rows = static_cast<uint32_t>(length(face.up) * texels_per_metre);
            rects.push_back({static_cast<uint32_t>(rects.size()), 0, height, columns, rows, 0});
            width = std::max(width, columns);
            height += rows + 2;
        }
        for (uint32_t i = 0; i < kLamps; ++i)
            lamps.push_back({static_cast<uint32_t>(formats::ReceiverLampKind::light), i});
        valid.resize(size_t{width} * height);
        light.resize(valid.size() * kLamps);
        const std::array<Lamp, kLamps> hung = hangLamps(seed);
        const std::array<Face, 6> faces = roomFaces();
        for (size_t i = 0; i < faces.size(); ++i)
            lightFace(faces[i], rects[i], hung);
    }
    void lightFace(const Face& face, const formats::ReceiverRectRecord& rect, std::span<const Lamp> hung)
    {
        for (uint32_t y = 0; y < rect.height; ++y)
            for (uint32_t x = 0; x < rect.width; ++x)
            {
                const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(rect.width);
                const float v = (static_cast<float>(y) + 0.5f) / static_cast<float>(rect.height);
                const Float3 place = face.corner + face.along * u + face.up * v;
                const size_t texel = size_t{rect.y + y} * width + rect.x + x;
                valid[texel] = 1;
                ++texel_count;
                for (size_t lamp = 0; lamp < kLamps; ++lamp)
                    light[texel * kLamps + lamp] = irradiance(hung[lamp], place, face.normal);
            }
    }
    BakedLight baked() const { return {width, height, lamps, rects, valid, light}; }

    uint32_t width = 0, height = 0;
    size_t texel_count = 0;
    std::vector<formats::ReceiverRectRecord> rects;
    std::vector<formats::ReceiverLampRecord> lamps;
    std::vector<uint8_t> valid;
    std::vector<Float3> light;
};

using Weights = std::array<Float3, kLamps>;

/// Luminance of all texels under some weights.
using Picture = std::vector<double>;

/// Return the luminance of lamps' light under weights.
double weigh(std::span<const Float3> light, const Weights& weights)
{
    Double3 sum{};
    for (size_t lamp = 0; lamp < kLamps; ++lamp)
        sum = sum + widen(light[lamp] * weights[lamp]);
    return receivers::luminance(sum);
}

Picture takePicture(const Room& room, const Weights& weights)
{
    Picture picture(room.valid.size());
    for (size_t texel = 0; texel < picture.size(); ++texel)
        picture[texel] = weigh(std::span(room.light).subspan(texel * kLamps, kLamps), weights);
    return picture;
}

/// Errors of a rule.
struct Errors
{
    double squares = 0, light = 0; ///< sums over texels and weights
    double jump = 0; ///< largest difference of the error between neighbours, as a share of all lamps' light

    double rms() const { return std::sqrt(squares / light); }
};

/// Add the errors of a picture, and the jumps between texels of the same face.
void addErrors(const Room& room, const Picture& all_on, const Picture& exact, const Picture& got,
               Errors& errors)
{
    const auto compare = [&](size_t a, size_t b)
    {
        const double jump = std::abs((got[a] - exact[a]) - (got[b] - exact[b]));
        errors.jump = std::max(errors.jump, jump / std::min(all_on[a], all_on[b]));
    };
    for (const formats::ReceiverRectRecord& rect : room.rects)
        for (uint32_t y = rect.y; y < rect.y + rect.height; ++y)
            for (uint32_t x = rect.x; x < rect.x + rect.width; ++x)
            {
                const size_t texel = size_t{y} * room.width + x;
                errors.squares += std::pow(got[texel] - exact[texel], 2);
                errors.light += exact[texel] * exact[texel];
                if (x > rect.x)
                    compare(texel, texel - 1);
                if (y > rect.y)
                    compare(texel, texel - room.width);
            }
}

/// Random weights, one for all channels of a lamp.
std::vector<Weights> drawWeights(size_t count)
{
    std::mt19937 random(4);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<Weights> draws(count);
    for (Weights& weights : draws)
        for (Float3& weight : weights)
            weight = Float3{1, 1, 1} * unit(random);
    return draws;
}

/// Figures of a rule.
struct Figures
{
    Errors all_on, random;
    double triples = 0; ///< records of three colours a texel
    double bytes = 0;   ///< a texel
};

/// Measure a rule.
/// show  makes the picture of the rule under weights
Figures measureRule(const Room& room, std::span<const Weights> draws,
                    const std::function<Picture(const Weights&)>& show)
{
    Weights ones;
    ones.fill({1, 1, 1});
    const Picture all_on = takePicture(room, ones);
    Figures figures;
    addErrors(room, all_on, all_on, show(ones), figures.all_on);
    for (const Weights& weights : draws)
        addErrors(room, all_on, takePicture(room, weights), show(weights), figures.random);
    return figures;
}

/// Measure a rule that keeps these lights of all texels.
/// kept  [texels][lamps]
Figures measureKept(const Room& room, std::span<const Float3> kept, std::span<const Weights> draws)
{
    return measureRule(room, draws,
                       [&](const Weights& weights)
                       {
                           Picture picture(room.valid.size());
                           for (size_t i = 0; i < picture.size(); ++i)
                               picture[i] = weigh(kept.subspan(i * kLamps, kLamps), weights);
                           return picture;
                       });
}

/// The rule that ships: atlas, update and both codecs.
Figures measureAtlas(const Room& room, const receivers::AtlasOptions& options, std::span<const Weights> draws)
{
    const receivers::Atlas atlas = receivers::packAtlas(room.baked(), options);
    std::vector<uint32_t> texels(room.valid.size());
    Figures figures =
        measureRule(room, draws,
                    [&](const Weights& weights)
                    {
                        pack::updateReceivers(atlas.tables(), weights, 15, texels);
                        Picture picture(texels.size());
                        for (size_t i = 0; i < texels.size(); ++i)
                        {
                            const std::array<float, 3> color = formats::decodeSharedExponent(texels[i]);
                            picture[i] = receivers::luminance(widen(Float3{color[0], color[1], color[2]})) *
                                         double{atlas.record.scale};
                        }
                        return picture;
                    });
    figures.triples = static_cast<double>(atlas.triple_count) / static_cast<double>(room.texel_count);
    figures.bytes = static_cast<double>(atlas.words.size() * sizeof(uint32_t) +
                                        atlas.blocks.size() * sizeof(formats::ReceiverBlockRecord)) /
                    static_cast<double>(room.texel_count);
    return figures;
}

/// The rule alone, in double.
Figures measureChoice(const Room& room, const receivers::SelectOptions& options,
                      std::span<const Weights> draws)
{
    std::vector<Float3> kept(room.light.size());
    std::vector<KeptLight> lamps;
    uint64_t triples = 0, words = 0;
    for (size_t texel = 0; texel < room.valid.size(); ++texel)
    {
        receivers::selectLights(std::span(room.light).subspan(texel * kLamps, kLamps), false, options, lamps);
        for (const KeptLight& lamp : lamps)
            kept[texel * kLamps + lamp.lamp] = narrow(lamp.color);
        triples += (lamps.size() + 2) / 3;
        words += room.valid[texel] != 0 ? 1 + lamps.size() : 0;
    }
    Figures figures = measureKept(room, kept, draws);
    figures.triples = static_cast<double>(triples) / static_cast<double>(room.texel_count);
    figures.bytes = static_cast<double>(4 * words) / static_cast<double>(room.texel_count);
    return figures;
}

/// The reference: the three brightest lamps, the others dropped.
Figures measureHardRule(const Room& room, std::span<const Weights> draws)
{
    std::vector<Float3> kept = room.light;
    for (size_t texel = 0; texel < room.valid.size(); ++texel)
    {
        const std::span light = std::span(kept).subspan(texel * kLamps, kLamps);
        std::array<double, kLamps> order;
        for (size_t lamp = 0; lamp < kLamps; ++lamp)
            order[lamp] = receivers::luminance(widen(light[lamp]));
        std::array<double, kLamps> sorted = order;
        std::sort(sorted.begin(), sorted.end(), std::greater<>());
        for (size_t lamp = 0; lamp < kLamps; ++lamp)
            if (order[lamp] < sorted[2])
                light[lamp] = {};
    }
    Figures figures = measureKept(room, kept, draws);
    figures.triples = 1;
    figures.bytes = 16;
    return figures;
}

void print(const char* rule, const Figures& figures)
{
    std::printf("%-32s all on %5.2f %% rms, random weights %5.2f %% rms, jump %5.2f %%, %.2f threes, %.1f "
                "bytes a texel\n",
                rule, 100 * figures.all_on.rms(), 100 * figures.random.rms(),
                100 * std::max(figures.all_on.jump, figures.random.jump), figures.triples, figures.bytes);
}

/// Measure how long an update of all texels takes, ms.
double timeUpdate(const Room& room)
{
    const receivers::Atlas atlas = receivers::packAtlas(room.baked(), {});
    std::vector<uint32_t> texels(room.valid.size());
    Weights ones;
    ones.fill({1, 1, 1});
    double best = 1e9;
    for (int i = 0; i < 5; ++i)
    {
        const auto start = std::chrono::steady_clock::now();
        pack::updateReceivers(atlas.tables(), ones, 15, texels);
        const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
        best = std::min(best, took.count());
    }
    return best;
}

/// Measure all rules in a room, and record the figures of the one that ships.
void measureRoom(const Room& room, std::span<const Weights> draws, bench::Judgement& judgement)
{
    std::printf("%zu texels, %zu lamps over %g m\n", room.texel_count, kLamps, double{kRoom.x});
    print("three, hard", measureHardRule(room, draws));
    receivers::AtlasOptions options;
    options.select.max_colors = 3;
    print("three by rank", measureAtlas(room, options, draws));
    options.select.max_colors = shared::kMaxReceiverColors;
    print("threshold, unrounded", measureChoice(room, options.select, draws));
    const Figures chosen = measureAtlas(room, options, draws);
    print("threshold, RGB9E5", chosen);
    options.codec = formats::ReceiverCodec::rgbm;
    print("threshold, RGBM", measureAtlas(room, options, draws));
    std::printf("update of all texels by one thread: %.1f ms\n", timeUpdate(room));
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
    const std::vector<Weights> draws = drawWeights(draw_count);
    bench::Judgement judgement("receivers");
    for (uint32_t seed = 1; seed <= kRooms; ++seed)
        measureRoom(Room(static_cast<float>(texels_per_metre), seed), draws, judgement);
    return judgement.finish();
}
