// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/cook/animation/random_characters.h"
#include "tests/support/sanitized.h"

#include <algorithm>
#include <cmath>

namespace hearth::test
{

using namespace formats;

namespace
{

constexpr size_t kClusters = kSanitized ? 4 : 12;
constexpr size_t kVertices = 24;

class Maker
{
public:
    Maker(const CharacterSpec& spec, uint32_t seed) : spec_(spec), random_(seed) {}

    Character make()
    {
        addNodes();
        addSkin();
        for (uint32_t clip = 0; clip < spec_.clips; ++clip)
            addClip();
        for (size_t i = 0; i < kClusters; ++i)
            character_.mesh.clusters.push_back(cluster());
        return std::move(character_);
    }

private:
    double uniform(double low, double high)
    {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    float value(double low, double high) { return static_cast<float>(uniform(low, high)); }
    uint32_t below(size_t count) { return static_cast<uint32_t>(random_() % count); }
    Float3 direction()
    {
        const Float3 v{value(-1, 1), value(-1, 1), value(-1, 1)};
        return normalizeOr(v, {1, 0, 0});
    }
    Float4 turn(double angle)
    {
        const Float3 axis = direction() * static_cast<float>(std::sin(angle / 2));
        return {axis.x, axis.y, axis.z, static_cast<float>(std::cos(angle / 2))};
    }
    static Float4 product(Float4 a, Float4 b)
    {
        return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
                a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
    }

    void addNodes()
    {
        for (uint32_t i = 0; i <= spec_.joints; ++i)
        {
            NodeRecord node{};
            node.mesh = node.skin = node.parent = kInvalidIndex;
            node.has_trs = 1;
            node.rotation = turn(uniform(0, 1));
            node.scale = {1, 1, 1};
            if (i > 0 && !(spec_.several_roots && below(5) == 0))
                // mostly a chain, for long paths from joint to joint
                node.parent = below(3) == 0 ? below(i) : i - 1;
            if (i > 0)
                node.translation = direction() * value(0.1, 0.3);
            if (spec_.mirrored && below(4) == 0)
                node.scale.x = -1;
            if (spec_.matrices && below(3) == 0)
            {
                node.has_trs = 0;
                for (int r = 0; r < 3; ++r)
                    for (int c = 0; c < 4; ++c)
                        node.parent_from_node.m[r][c] = (r == c ? 1.0f : 0.0f) + value(-0.2, 0.2);
            }
            character_.nodes.push_back(node);
        }
        NodeRecord& mesh = character_.nodes.back();
        mesh.mesh = 0;
        mesh.skin = 0;
        mesh.morph_weights = {0, spec_.morph_targets};
        character_.morph_weights.assign(spec_.morph_targets, 0.25f);
        character_.mesh.node = spec_.joints;
        character_.mesh.skin = 0;
    }

    void addSkin()
    {
        const AnimationTables tables = character_.tables();
        std::vector<Affine3d> world(tables.nodes.size());
        poseNodes(tables, restPose(tables), nodesParentsFirst(tables.nodes), world);
        for (uint32_t i = 0; i < spec_.joints; ++i)
        {
            // bind pose near the rest pose, but slightly off
            Affine3d bind = world[i];
            bind.m[0][3] += uniform(-0.02, 0.02);
            places_.push_back(narrow(transformPoint(bind, {})));
            character_.joints.push_back({i, {}, narrowed(inverted(bind).value()).value()});
        }
        character_.skins.push_back({{}, kInvalidIndex, {0, spec_.joints}, 0});
    }

    Float4 keyRotation(Float4 rest, Float4 last)
    {
        Float4 q = product(rest, turn(uniform(-spec_.swing, spec_.swing)));
        if (spec_.spins)
            q = below(2) == 0 ? turn(uniform(0, 6.28)) : product(last, turn(3.1));
        const float sign = spec_.opposite && below(2) == 0 ? -1.0f : 1.0f;
        return {q.x * sign, q.y * sign, q.z * sign, q.w * sign};
    }

    void addValue(std::span<const float> components)
    {
        // tangents of any size: the spline leaves the range of its keys
        const auto addTangent = [&]
        {
            for (size_t i = 0; i < components.size(); ++i)
                character_.keys.push_back(value(-2, 2));
        };
        if (spline_)
            addTangent();
        character_.keys.insert(character_.keys.end(), components.begin(), components.end());
        if (spline_)
            addTangent();
    }

    void addChannel(uint32_t node, AnimationPath path, uint32_t components)
    {
        const Interpolation kind = spec_.splines   ? Interpolation::cubic_spline
                                   : below(4) == 0 ? Interpolation::step
                                                   : Interpolation::linear;
        spline_ = kind == Interpolation::cubic_spline;
        AnimationChannelRecord channel{};
        channel.target = node;
        channel.path = static_cast<uint32_t>(path);
        channel.interpolation = static_cast<uint32_t>(kind);
        channel.components = components;
        channel.key_count = spec_.keys;
        channel.first_time = static_cast<uint32_t>(character_.keys.size());
        for (uint32_t key = 0; key < spec_.keys; ++key)
            character_.keys.push_back(static_cast<float>(key) * 0.25f);
        channel.first_value = static_cast<uint32_t>(character_.keys.size());
        Float4 last = character_.nodes[node].rotation;
        for (uint32_t key = 0; key < spec_.keys; ++key)
        {
            if (path == AnimationPath::rotation)
            {
                last = keyRotation(character_.nodes[node].rotation, last);
                addValue(std::array{last.x, last.y, last.z, last.w});
                continue;
            }
            std::vector<float> components_of_key;
            const Float3 rest = character_.nodes[node].translation;
            for (uint32_t c = 0; c < components; ++c)
                components_of_key.push_back(
                    path == AnimationPath::translation ? rest[static_cast<int>(c)] + value(-0.05, 0.05)
                    : path == AnimationPath::scale     ? value(spec_.scale_low, spec_.scale_high)
                                                       : value(-0.5, 1.5));
            addValue(components_of_key);
        }
        character_.channels.push_back(channel);
    }

    void addClip()
    {
        AnimationRecord animation{};
        animation.channels.first = static_cast<uint32_t>(character_.channels.size());
        for (uint32_t node = 0; node < spec_.joints; ++node)
        {
            if (character_.nodes[node].has_trs == 0 || below(5) == 0)
                continue;
            addChannel(node, AnimationPath::rotation, 4);
            if (below(3) == 0)
                addChannel(node, AnimationPath::translation, 3);
            if (spec_.scale_low != spec_.scale_high && below(2) == 0)
                addChannel(node, AnimationPath::scale, 3);
        }
        if (spec_.morph_targets > 0)
            addChannel(character_.mesh.node, AnimationPath::weights, spec_.morph_targets);
        animation.channels.count =
            static_cast<uint32_t>(character_.channels.size()) - animation.channels.first;
        animation.duration = static_cast<float>(spec_.keys - 1) * 0.25f;
        character_.animations.push_back(animation);
    }

    /// Add a patch of triangles around a joint.
    skinning::DeformedCluster cluster()
    {
        skinning::DeformedCluster cluster;
        const uint32_t joint = below(spec_.joints);
        const Float3 side = direction();
        cluster.influences = spec_.influences;
        for (size_t v = 0; v < kVertices; ++v)
        {
            const Float3 step{static_cast<float>(v % 4) * 0.03f, static_cast<float>(v / 4) * 0.03f,
                              value(0, 0.05)};
            cluster.positions.push_back(places_[joint] + side * 0.05f + step);
            addInfluences(cluster, joint);
        }
        for (uint32_t v = 0; v + 4 < kVertices; ++v)
            if (v % 4 != 3)
                cluster.indices.insert(cluster.indices.end(), {v, v + 1, v + 4, v + 1, v + 5, v + 4});
        for (uint32_t target = 0; target < spec_.morph_targets; ++target)
        {
            skinning::MorphDeltas morph{target, {}};
            for (size_t v = 0; v < kVertices; ++v)
                morph.positions.push_back(direction() * value(0, 0.05));
            cluster.morphs.push_back(std::move(morph));
        }
        return cluster;
    }

    void addInfluences(skinning::DeformedCluster& cluster, uint32_t joint)
    {
        std::vector<double> weights;
        double sum = 0;
        for (uint32_t i = 0; i < spec_.influences; ++i)
        {
            if (i > 0 && spec_.far_influences)
                joint = below(spec_.joints);
            cluster.joints.push_back(static_cast<uint16_t>(joint));
            // its parent next, if the parent is a joint
            if (character_.nodes[joint].parent != kInvalidIndex)
                joint = character_.nodes[joint].parent;
            weights.push_back(below(4) == 0 ? 0.0 : uniform(0, 1));
            sum += weights.back();
        }
        if (!(sum > 0))
            weights[0] = sum = 1;
        for (const double weight : weights)
            cluster.weights.push_back(weight / sum);
    }

    CharacterSpec spec_;
    std::mt19937 random_;
    Character character_;
    std::vector<Float3> places_;
    bool spline_ = false;
};

} // namespace

Character randomCharacter(const CharacterSpec& spec, uint32_t seed)
{
    return Maker(spec, seed).make();
}

} // namespace hearth::test
