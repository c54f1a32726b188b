// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/market/evening.h"

#include "sample_assets/market/pieces.h"
#include "sample_assets/market/street.h"
#include "sample_assets/shapes/noise.h"
#include "sample_assets/shapes/sample_math.h"
#include "sample_assets/shapes/scene_parts.h"
#include "sample_assets/shapes/shapes.h"

namespace hearth::samples::market
{

namespace
{

constexpr float kCartSpeed = 1.3f, kWheelRadius = 0.36f; ///< metres a second, metres

Float4 asKey(Float3 v)
{
    return {v.x, v.y, v.z, 0};
}

/// Add a track whose keys are those of a function of the time.
template <typename Function>
void addTrack(Animation& clip, int node, TrackPath path, float per_second, const Function& key)
{
    Track track{node, path, TrackKind::linear, eveningTimes(per_second), {}};
    for (const float time : track.times)
        track.values.push_back(key(time));
    clip.tracks.push_back(std::move(track));
}

int addChild(Document& document, int parent, Node node)
{
    const int child = add(document.nodes, std::move(node));
    document.nodes[static_cast<size_t>(parent)].children.push_back(child);
    return child;
}

/// Add a node that swings about `pivot`, and a lantern below it; return the fixture of its light.
/// period  seconds; a fraction of the clip's length, so that it loops
Fixture addSwingingLantern(Document& document, int mesh, uint32_t paper, int parent, Float3 pivot,
                           float period, Animation& clip)
{
    Node node;
    node.name = "swing";
    node.placement.translation = pivot;
    const int swing = parent == kNoIndex ? addRoot(document, node) : addChild(document, parent, node);
    const float phase = 2 * kPi * randomUnit(static_cast<uint32_t>(swing), 1301);
    addTrack(clip, swing, TrackPath::rotation, 8,
             [&](float time)
             {
                 const float angle = 0.20f * sine(2 * kPi * time / period + phase);
                 const float aside = 0.07f * sine(4 * kPi * time / period + 2 * phase);
                 return multiply(rotationAbout({1, 0, 0}, angle), rotationAbout({0, 0, 1}, aside));
             });
    Node lantern;
    lantern.name = "swinging_lantern";
    lantern.mesh = mesh;
    lantern.placement.translation = {0, -kLanternDrop, 0};
    Fixture fixture{.kind = FixtureKind::moving};
    fixture.light_drop = kLanternLightDrop;
    fixture.color = kPaperColors[paper];
    fixture.range = 6.5f;
    fixture.node = addChild(document, swing, lantern);
    return fixture;
}

TriangleMesh makeCart()
{
    TriangleMesh cart = makeBlock({-0.5f, 0.5f, -0.9f}, {0.5f, 0.56f, 0.9f});
    for (const float x : {-0.5f, 0.47f})
        append(cart, makeBlock({x, 0.56f, -0.9f}, {x + 0.03f, 0.78f, 0.9f}));
    for (const float z : {-0.9f, 0.87f})
        append(cart, makeBlock({-0.47f, 0.56f, z}, {0.47f, 0.78f, z + 0.03f}));
    for (const float x : {-0.46f, 0.46f})
        for (const float z : {-0.85f, 0.85f})
            append(cart, makeBlock({x - 0.025f, 0.56f, z - 0.025f}, {x + 0.025f, 1.95f, z + 0.025f}));
    for (const float x : {-0.4f, 0.4f})
        append(cart, makeRod({x, 0.53f, 0.88f}, {x, 0.98f, 1.45f}, 0.025f));
    append(cart, makeRod({-0.45f, 0.97f, 1.44f}, {0.45f, 0.975f, 1.44f}, 0.022f));
    append(cart, makeBlock({-0.06f, 0, 0.7f}, {0.06f, 0.5f, 0.76f}));
    return cart;
}

TriangleMesh makeWheel()
{
    TriangleMesh wheel = makeLathe(
        {{0.30f, 0.025f}, {kWheelRadius, 0.025f}, {kWheelRadius, -0.025f}, {0.30f, -0.025f}, {0.30f, 0.025f}},
        28);
    append(wheel, makeTurned({{0.05f, 0.05f}, {0.05f, -0.05f}}, 12));
    wheel = transformed(wheel, {.rotation = rotationAbout({0, 0, 1}, kPi / 2)});
    for (uint32_t i = 0; i < 6; ++i)
    {
        const float angle = kPi / 3 * static_cast<float>(i);
        append(wheel, makeRod({0, 0.04f * sine(angle), 0.04f * cosine(angle)},
                              {0, 0.31f * sine(angle), 0.31f * cosine(angle)}, 0.016f, 6));
    }
    return wheel;
}

/// Add the cart: wheels that turn, a roof, fruit, and a lantern at each end.
void addCart(Document& document, const LampModels& models, Animation& clip, std::vector<Fixture>& fixtures)
{
    const int wood = addPlainMaterial(document, "cart_wood", {0.32f, 0.10f, 0.06f}, 0.55f);
    const int cloth = addPlainMaterial(document, "cart_cloth", {0.55f, 0.42f, 0.12f}, 0.9f);
    const TriangleMesh roof =
        makeSheet(8, 12, 0.02f,
                  [](Float2 uv)
                  {
                      const float x = 2 * uv.x - 1;
                      return Float3{0.72f * x, 2.12f - 0.18f * x * x, lerp(1.1f, -1.1f, uv.y)};
                  });
    TriangleMesh fruit;
    for (uint32_t i = 0; i < 70; ++i)
    {
        const auto random = [&](uint32_t which) { return randomUnit(i * 4 + which, 1311); };
        const Float3 at{0.8f * (random(0) - 0.5f), 0.64f + 0.12f * random(1), 1.6f * (random(2) - 0.5f)};
        append(fruit, moved(makeBall({0.075f, 0.07f, 0.075f}, 10), at));
    }
    const int orange = addPlainMaterial(document, "oranges", {0.68f, 0.22f, 0.02f}, 0.4f);
    Node node;
    node.name = "cart";
    node.mesh = add(document.meshes, Mesh{"cart", {{makeCart(), wood}, {roof, cloth}, {fruit, orange}}});
    node.placement.translation = cartPosition(0);
    const int cart = addRoot(document, node);
    addTrack(clip, cart, TrackPath::translation, 2, [](float time) { return asKey(cartPosition(time)); });

    const int wheel_mesh = addMesh(document, "wheel", makeWheel(), wood);
    for (const float side : {-1.0f, 1.0f})
    {
        Node wheel;
        wheel.name = "wheel";
        wheel.mesh = wheel_mesh;
        wheel.placement.translation = {side * 0.57f, kWheelRadius, 0};
        addTrack(clip, addChild(document, cart, wheel), TrackPath::rotation, 8,
                 [](float time) {
                     return rotationAbout({1, 0, 0}, -kCartSpeed * time / kWheelRadius);
                 });
    }
    for (const float z : {-1.05f, 1.05f})
    {
        Fixture fixture = addSwingingLantern(document, models.lanterns[1], 1, cart, {0, 2.1f, z},
                                             kEveningSeconds / 8, clip);
        fixtures.push_back(fixture);
    }
}

/// Add fireflies that circle about the crowns of the trees where the lanes cross.
void addFireflies(Document& document, const Plan& plan, Animation& clip, std::vector<Fixture>& fixtures)
{
    constexpr uint32_t kFireflies = 8;
    constexpr Float3 kGlow{0.62f, 1.0f, 0.22f};
    const int glow = addEmissiveMaterial(document, "firefly", kGlow, 14);
    const int mesh = addMesh(document, "firefly", makeBall({0.018f, 0.018f, 0.03f}, 8), glow);
    for (uint32_t i = 0; i < kFireflies; ++i)
    {
        const auto random = [&](uint32_t which) { return randomUnit(i * 8 + which, 1321); };
        const Float3 middle = fromPlacement(plan.trees[i % 4], {0, 1.75f + 0.6f * random(0), 0});
        const float away = 1.0f + 0.5f * random(1), phase = 2 * kPi * random(2);
        const float turns = i % 2 == 0 ? 2.0f : -1.0f;
        const auto place = [&](float time)
        {
            const float angle = 2 * kPi * turns * time / kEveningSeconds + phase;
            return middle + Float3{away * cosine(angle), 0.3f * sine(3 * angle), away * sine(angle)};
        };
        Node node;
        node.name = "firefly";
        node.mesh = mesh;
        node.placement.translation = place(0);
        Fixture fixture{.kind = FixtureKind::moving};
        fixture.color = kGlow;
        fixture.range = 2;
        fixture.flicker = 0.6f;
        fixture.node = addRoot(document, node);
        addTrack(clip, fixture.node, TrackPath::translation, 4,
                 [&](float time) { return asKey(place(time)); });
        fixtures.push_back(fixture);
    }
}

/// Return a track of neon that starts with a flutter, every 3 seconds, and then is on.
/// intensity  candela
LightTrack makeBlinking(int light, float intensity)
{
    LightTrack track{light, LightProperty::intensity, TrackKind::step, {}, {}};
    constexpr std::array<std::pair<float, float>, 6> kFlutter{
        {{0.0f, 1.0f}, {2.0f, 0.0f}, {2.375f, 1.0f}, {2.5f, 0.0f}, {2.625f, 0.6f}, {2.75f, 0.0f}}};
    for (float start = 0; start < kEveningSeconds; start += 3)
        for (const auto& [time, share] : kFlutter)
        {
            track.times.push_back(start + time);
            track.values.push_back({share * intensity, 0, 0});
        }
    track.times.push_back(kEveningSeconds);
    track.values.push_back({intensity, 0, 0});
    return track;
}

/// Return a track that goes through the colours of papers and ends where it began.
LightTrack makeColorful(int light, uint32_t first)
{
    LightTrack track{light, LightProperty::color, TrackKind::linear, {}, {}};
    for (uint32_t i = 0; i <= kPaperCount; ++i)
    {
        track.times.push_back(kEveningSeconds * static_cast<float>(i) / kPaperCount);
        track.values.push_back(kPaperColors[(first + i) % kPaperCount]);
    }
    return track;
}

} // namespace

Float3 cartPosition(float seconds)
{
    const Float2 at{-1.35f, 11.5f - kCartSpeed * seconds};
    return {at.x, groundHeight(at), at.y};
}

std::vector<float> eveningTimes(float per_second)
{
    std::vector<float> times;
    const auto last = static_cast<uint32_t>(kEveningSeconds * per_second);
    for (uint32_t i = 0; i <= last; ++i)
        times.push_back(static_cast<float>(i) / per_second);
    return times;
}

std::vector<Fixture> addMovingLamps(Document& document, const Plan& plan, const LampModels& models,
                                    Animation& evening)
{
    std::vector<Fixture> fixtures;
    for (const LampString& string : plan.strings)
        for (uint32_t k = 0; string.swings && k < 5; ++k)
        {
            const uint32_t paper = k * 2 % kPaperCount;
            const Float3 pivot = stringPoint(string, (static_cast<float>(k) + 0.5f) / 5);
            fixtures.push_back(addSwingingLantern(document, models.lanterns[paper], paper, kNoIndex, pivot,
                                                  kEveningSeconds / 5, evening));
        }
    addCart(document, models, evening, fixtures);
    addFireflies(document, plan, evening, fixtures);
    return fixtures;
}

void addSignTracks(const Document& document, const std::vector<Fixture>& fixtures,
                   const std::vector<int>& light_of_fixture, Animation& evening)
{
    uint32_t signs = 0;
    for (size_t i = 0; i < fixtures.size(); ++i)
    {
        const int light = light_of_fixture[i];
        if (fixtures[i].kind != FixtureKind::sign || light == kNoIndex)
            continue;
        if (signs % 3 == 0)
            evening.light_tracks.push_back(
                makeBlinking(light, document.lights[static_cast<size_t>(light)].intensity));
        else if (signs % 3 == 1)
            evening.light_tracks.push_back(makeColorful(light, fixtures[i].look));
        ++signs;
    }
}

} // namespace hearth::samples::market
