// Builds a scene of rocks on nodes that clips move.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/support/test_scene.h"

namespace hearth::test
{

/// Add a node with translation, rotation and scale; returns its index.
inline uint32_t addTrsNode(PackModel& model, uint32_t parent, Float3 translation)
{
    formats::NodeRecord node{};
    node.parent = parent;
    node.mesh = node.skin = kInvalidIndex;
    node.has_trs = 1;
    node.translation = translation;
    node.rotation = {0, 0, 0, 1};
    node.scale = {1, 1, 1};
    node.parent_from_node = translated(translation);
    model.nodes.push_back(node);
    return static_cast<uint32_t>(model.nodes.size()) - 1;
}

/// Add a clip, by name, that moves a node on a straight line from time 0 to `seconds`.
inline void addSlide(PackModel& model, const std::string& name, uint32_t node, float seconds, Float3 from,
                     Float3 to)
{
    const auto first = static_cast<uint32_t>(model.keys.size());
    for (const float key : {0.0f, seconds, from.x, from.y, from.z, to.x, to.y, to.z})
        model.keys.push_back(key);
    formats::AnimationChannelRecord channel{};
    channel.target = node;
    channel.path = static_cast<uint32_t>(formats::AnimationPath::translation);
    channel.interpolation = static_cast<uint32_t>(formats::Interpolation::linear);
    channel.components = 3;
    channel.key_count = 2;
    channel.first_time = first;
    channel.first_value = first + 2;
    const formats::StringRef text{static_cast<uint32_t>(model.strings.size()),
                                  static_cast<uint32_t>(name.size())};
    model.strings += name;
    const auto index = static_cast<uint32_t>(model.channels.size());
    model.animations.push_back({text, {index, 1}, {index + 1, 0}, seconds, 0});
    model.channels.push_back(channel);
}

/// Fill the scene. Rock 0 stands at the origin. Rock 1 is on a node that "slide" moves from (2, 0, 0) to (6,
/// 0, 0) in four seconds, and "rise" to (2, 4, 0). Rock 2 is one metre above it, on a child node. Rock 3 is
/// like rock 1, but instancing moves it on by three metres.
inline void fillAnimatedRocks(TestScene& test, uint32_t mesh)
{
    PackModel& model = test.model();
    test.addInstance(mesh, Affine3{});
    const uint32_t node = addTrsNode(model, kInvalidIndex, {2, 0, 0});
    const uint32_t below = addTrsNode(model, node, {0, 1, 0});
    const auto add = [&](uint32_t on, Float3 place)
    {
        test.addInstance(mesh, translated(place));
        model.instances.back().node = on;
        model.nodes[on].mesh = mesh;
        model.nodes.pop_back(); // the node that addInstance made
    };
    add(node, {2, 0, 0});
    add(below, {2, 1, 0});
    add(node, {2, 0, 3});
    addSlide(model, "slide", node, 4, {2, 0, 0}, {6, 0, 0});
    addSlide(model, "rise", node, 4, {2, 0, 0}, {2, 4, 0});
}

} // namespace hearth::test
