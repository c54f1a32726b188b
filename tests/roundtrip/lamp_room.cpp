// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/roundtrip/lamp_room.h"

#include "sample_assets/shapes/sample_math.h"
#include "sample_assets/shapes/scene_parts.h"
#include "sample_assets/shapes/shapes.h"

namespace hearth::test
{

namespace
{

using namespace samples;

constexpr float kHeight = 2.6f;                          ///< of the room, metres
constexpr float kTubeHeight = 1.5f;                      ///< of the character
constexpr float kWaist = 0.75f;                          ///< height of its second joint
constexpr float kBend = 60;                              ///< degrees
constexpr Float4 kDown{-0.70710678f, 0, 0, 0.70710678f}; ///< turns -Z to -Y

/// Add a wall from a corner along two edges, facing u x v.
void addWall(Document& document, const char* name, Float3 corner, Float3 u, Float3 v, Float3 color)
{
    TriangleMesh wall = makeGrid(8, 8,
                                 [&](Float2 uv, Float3& position, Float2& texture_uv)
                                 {
                                     position = corner + u * uv.x + v * uv.y;
                                     texture_uv = uv;
                                 });
    setFlatNormals(wall);
    addObject(document, name, {{wall, addPlainMaterial(document, name, color)}});
}

void addLamp(Document& document, const char* name, LightKind kind, Float3 color, float intensity,
             Float3 position)
{
    samples::Light light;
    light.name = name;
    light.kind = kind;
    light.color = color;
    light.intensity = intensity;
    light.outer_cone_rad = 0.6f;
    addLight(document, light, position, kDown);
}

TriangleMesh makeTube()
{
    std::vector<Float2> profile{{0, kTubeHeight}, {0.1f, kTubeHeight - 0.03f}};
    constexpr int kRings = 12;
    for (int ring = 0; ring <= kRings; ++ring)
        profile.push_back({0.16f, (kTubeHeight - 0.1f) * (1 - static_cast<float>(ring) / kRings)});
    profile.push_back({0, 0});
    TriangleMesh tube = makeLathe(profile, 16);
    for (const Float3 p : tube.positions)
    {
        const float bent = smoothstep(kWaist - 0.2f, kWaist + 0.2f, p.y);
        tube.joints.push_back({0, 1, 0, 0});
        tube.weights.push_back({1 - bent, bent, 0, 0});
    }
    return tube;
}

void addCharacter(Document& document)
{
    Node chest;
    chest.name = "chest";
    chest.placement.translation = {0, kWaist, 0};
    const int chest_node = add(document.nodes, chest);
    Node hip;
    hip.name = kHipName;
    hip.placement.translation = {0.35f, 0, -0.5f};
    hip.children = {chest_node};
    const int hip_node = addRoot(document, hip);

    Skin skin;
    skin.name = "tube";
    skin.joints = {hip_node, chest_node};
    skin.joint_from_bind = {Affine3{}, Affine3{}};
    skin.joint_from_bind[1].m[1][3] = -kWaist;
    skin.skeleton_root = hip_node;
    addObject(document, "character", {{makeTube(), addPlainMaterial(document, "skin", {0.6f, 0.5f, 0.4f})}});
    document.nodes.back().skin = add(document.skins, skin);

    const float half = kBend * kPi / 360;
    Animation bend{"bend", {}};
    bend.tracks.push_back({chest_node,
                           TrackPath::rotation,
                           TrackKind::linear,
                           {0, 1},
                           {{0, 0, 0, 1}, {0, 0, sine(half), cosine(half)}}});
    document.animations.push_back(bend);
}

} // namespace

samples::Document makeLampRoom()
{
    Document document;
    const Float3 x{4, 0, 0}, y{0, kHeight, 0}, z{0, 0, 4};
    addWall(document, "floor", {-2, 0, 2}, x, z * -1.0f, {0.5f, 0.5f, 0.5f});
    addWall(document, "ceiling", {-2, kHeight, -2}, x, z, {0.75f, 0.75f, 0.75f});
    addWall(document, "back", {-2, 0, -2}, x, y, {0.7f, 0.7f, 0.7f});
    addWall(document, "left", {-2, 0, 2}, z * -1.0f, y, {0.7f, 0.25f, 0.2f});
    addWall(document, "right", {2, 0, -2}, z, y, {0.25f, 0.6f, 0.3f});
    addObject(document, "plinth",
              {{makeBlock({-1.4f, 0, -1.3f}, {-0.7f, 0.8f, -0.6f}, 1),
                addPlainMaterial(document, "plaster", {0.7f, 0.7f, 0.7f})}});
    addObject(document, kPropName,
              {{makeBox({}, kPropHalf, 1), addPlainMaterial(document, "crate", {0.65f, 0.5f, 0.3f})}});
    document.nodes.back().placement.translation = kPropCenter;
    addCharacter(document);
    addLamp(document, "warm", LightKind::point, {1, 0.75f, 0.45f}, 3, {-0.6f, 2.1f, 0.5f});
    addLamp(document, "cold", LightKind::point, {0.4f, 0.6f, 1}, 4, {1.3f, 1.8f, -0.9f});
    addLamp(document, "red", LightKind::spot, {1, 0.2f, 0.15f}, 8, {0.4f, 2.5f, 0.9f});
    return document;
}

} // namespace hearth::test
