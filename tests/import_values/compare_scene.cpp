// Compares nodes, instances and skins.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/import_values/compare_part.h"

#include <algorithm>
#include <cmath>

namespace hearth::test
{

namespace
{

// relative to the largest number that goes into a matrix
constexpr double kMatrixSlack = 1e-6;

double largestIn(const SourceTransform& transform)
{
    double largest = 1;
    for (const auto& row : transform.m)
        for (const double number : row)
            largest = std::max(largest, std::abs(number));
    return largest;
}

void compareTransform(Value kind, const SourceTransform& source, const Affine3& part, double slack,
                      const char* what, size_t where, Comparison& comparison)
{
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
            comparison.check(kind, source.m[row][column], double{part.m[row][column]}, slack, what, where);
}

/// Rows are relative: a translation of a planet's radius must not hide a wrong rotation.
void compareRest(const SourceTransform& source, const Affine3& part, size_t node, Comparison& comparison)
{
    for (int row = 0; row < 3; ++row)
    {
        double linear = 1e-30;
        for (int column = 0; column < 3; ++column)
            linear = std::max(linear, std::abs(source.m[row][column]));
        for (int column = 0; column < 4; ++column)
            comparison.check(Value::node, source.m[row][column], double{part.m[row][column]},
                             kMatrixSlack *
                                 std::max(linear, column == 3 ? std::abs(source.m[row][3]) : linear),
                             "matrix of node", node);
    }
}

void compareVector(const std::vector<double>& source, const std::vector<double>& otherwise, const float* part,
                   size_t node, Comparison& comparison)
{
    const std::vector<double>& values = source.empty() ? otherwise : source;
    for (size_t i = 0; i < values.size(); ++i)
        comparison.check(Value::node, values[i], double{part[i]}, 0, "vector of node", node);
}

void compareRotation(const std::vector<double>& source, const Float4& part, size_t node,
                     Comparison& comparison)
{
    const std::vector<double> rotation = source.empty() ? std::vector<double>{0, 0, 0, 1} : source;
    double square = 0;
    for (const double value : rotation)
        square += value * value;
    const double in_part[4] = {double{part.x}, double{part.y}, double{part.z}, double{part.w}};
    for (size_t i = 0; i < 4; ++i)
        comparison.check(Value::node, rotation[i] / std::sqrt(square), in_part[i], 2e-7, "rotation of node",
                         node);
}

void compareRestWeights(const SourceModel& source, const formats::PackView& part, size_t index,
                        Comparison& comparison)
{
    const tinygltf::Node& node = source.model.nodes[index];
    const formats::Range range = part.nodes()[index].morph_weights;
    if (node.mesh < 0 || range.count == 0)
        return;
    const std::vector<double>& weights =
        node.weights.empty() ? source.model.meshes[static_cast<size_t>(node.mesh)].weights : node.weights;
    for (size_t i = 0; i < range.count; ++i)
        comparison.check(Value::node, i < weights.size() ? weights[i] : 0.0,
                         double{part.morphWeights()[range.first + i]}, 0, "weight of node", index);
}

std::vector<int> findParents(const tinygltf::Model& model)
{
    std::vector<int> parents(model.nodes.size(), -1);
    for (size_t node = 0; node < model.nodes.size(); ++node)
        for (const int child : model.nodes[node].children)
            parents.at(static_cast<size_t>(child)) = static_cast<int>(node);
    return parents;
}

/// World transform of a node, and the largest number on the way to it.
struct World
{
    SourceTransform transform;
    double largest = 1;
};

World worldTransform(const tinygltf::Model& model, const std::vector<int>& parents, size_t node)
{
    World world{nodeTransform(model.nodes[node]), 1};
    world.largest = largestIn(world.transform);
    for (int parent = parents[node]; parent >= 0; parent = parents[static_cast<size_t>(parent)])
    {
        const SourceTransform upper = nodeTransform(model.nodes[static_cast<size_t>(parent)]);
        world.transform = upper * world.transform;
        world.largest = std::max({world.largest, largestIn(upper), largestIn(world.transform)});
    }
    return world;
}

/// Return the transforms of EXT_mesh_gpu_instancing; one that changes nothing if the node has none.
std::vector<SourceTransform> readCopies(const SourceModel& source, const tinygltf::Node& node)
{
    const auto found = node.extensions.find("EXT_mesh_gpu_instancing");
    if (found == node.extensions.end())
        return {SourceTransform()};
    const tinygltf::Value& attributes = found->second.Get("attributes");
    const auto read = [&](const char* name) {
        return attributes.Has(name) ? readValues(source, attributes.Get(name).GetNumberAsInt())
                                    : SourceValues();
    };
    const SourceValues translations = read("TRANSLATION"), rotations = read("ROTATION"),
                       scales = read("SCALE");
    const size_t count =
        std::max({translations.values.size() / 3, rotations.values.size() / 4, scales.values.size() / 3});
    constexpr double kZero[3] = {0, 0, 0}, kNoTurn[4] = {0, 0, 0, 1}, kOne[3] = {1, 1, 1};
    std::vector<SourceTransform> copies;
    for (size_t i = 0; i < count; ++i)
        copies.push_back(fromTrs(translations.values.empty() ? kZero : &translations.values[i * 3],
                                 rotations.values.empty() ? kNoTurn : &rotations.values[i * 4],
                                 scales.values.empty() ? kOne : &scales.values[i * 3]));
    return copies;
}

/// Return the nodes of the scene that is drawn.
std::vector<bool> findDrawn(const tinygltf::Model& model)
{
    std::vector<bool> drawn(model.nodes.size(), model.scenes.empty());
    std::vector<int> open;
    if (!model.scenes.empty())
        open = model.scenes[model.defaultScene < 0 ? 0 : static_cast<size_t>(model.defaultScene)].nodes;
    while (!open.empty())
    {
        const auto node = static_cast<size_t>(open.back());
        open.pop_back();
        drawn.at(node) = true;
        open.insert(open.end(), model.nodes[node].children.begin(), model.nodes[node].children.end());
    }
    return drawn;
}

/// True if a mesh has a primitive of triangles.
bool hasTriangles(const tinygltf::Mesh& mesh)
{
    return std::any_of(mesh.primitives.begin(), mesh.primitives.end(),
                       [](const tinygltf::Primitive& primitive)
                       {
                           return (primitive.mode < 0 || primitive.mode >= TINYGLTF_MODE_TRIANGLES) &&
                                  primitive.attributes.contains("POSITION");
                       });
}

} // namespace

void compareNodes(const SourceModel& source, const formats::PackView& part, Comparison& comparison)
{
    const std::vector<int> parents = findParents(source.model);
    comparison.checkEqual(static_cast<long long>(source.model.nodes.size()),
                          static_cast<long long>(part.nodes().size()), "number of nodes", 0);
    for (size_t i = 0; i < std::min(source.model.nodes.size(), part.nodes().size()); ++i)
    {
        const tinygltf::Node& node = source.model.nodes[i];
        const formats::NodeRecord& record = part.nodes()[i];
        comparison.checkEqual(parents[i], static_cast<int32_t>(record.parent), "parent of node", i);
        comparison.checkEqual(node.matrix.empty() ? 1 : 0, record.has_trs, "TRS of node", i);
        if (record.skin != kInvalidIndex)
            comparison.checkEqual(node.skin, static_cast<int32_t>(record.skin), "skin of node", i);
        compareRest(nodeTransform(node), record.parent_from_node, i, comparison);
        compareRestWeights(source, part, i, comparison);
        if (!node.matrix.empty())
            continue;
        compareVector(node.translation, {0, 0, 0}, &record.translation.x, i, comparison);
        compareVector(node.scale, {1, 1, 1}, &record.scale.x, i, comparison);
        compareRotation(node.rotation, record.rotation, i, comparison);
    }
}

void compareInstances(const SourceModel& source, const formats::PackView& part, Comparison& comparison)
{
    const std::vector<int> parents = findParents(source.model);
    const std::vector<bool> drawn = findDrawn(source.model);
    const bool has_levels = part.container().find(formats::kChunkAuthoredLods) != nullptr;
    std::vector<std::vector<const formats::InstanceRecord*>> of_node(source.model.nodes.size());
    for (const formats::InstanceRecord& instance : part.instances())
        of_node.at(instance.node).push_back(&instance);
    for (size_t i = 0; i < of_node.size(); ++i)
    {
        const tinygltf::Node& node = source.model.nodes[i];
        const bool is_drawn = drawn[i] && node.mesh >= 0 &&
                              hasTriangles(source.model.meshes.at(static_cast<size_t>(node.mesh)));
        if (has_levels && of_node[i].empty())
        {
            comparison.exclude(Exclusion::generated_level, is_drawn ? 1 : 0);
            continue;
        }
        if (part.nodes()[i].skin != kInvalidIndex && is_drawn)
        {
            comparison.checkEqual(1, static_cast<long long>(of_node[i].size()), "instances of node", i);
            comparison.exclude(Exclusion::skinned_instance);
            continue;
        }
        const std::vector<SourceTransform> copies = readCopies(source, node);
        comparison.checkEqual(is_drawn ? static_cast<long long>(copies.size()) : 0,
                              static_cast<long long>(of_node[i].size()), "instances of node", i);
        const World world = worldTransform(source.model, parents, i);
        for (size_t copy = 0; copy < std::min(copies.size(), of_node[i].size()); ++copy)
            compareTransform(
                Value::instance, world.transform * copies[copy], of_node[i][copy]->world_from_object,
                kMatrixSlack * world.largest * largestIn(copies[copy]), "of node", i, comparison);
    }
}

void compareSkins(const SourceModel& source, const formats::PackView& part, Comparison& comparison)
{
    comparison.checkEqual(static_cast<long long>(source.model.skins.size()),
                          static_cast<long long>(part.skins().size()), "number of skins", 0);
    for (size_t i = 0; i < std::min(source.model.skins.size(), part.skins().size()); ++i)
    {
        const tinygltf::Skin& skin = source.model.skins[i];
        const formats::SkinRecord& record = part.skins()[i];
        comparison.checkEqual(static_cast<long long>(skin.joints.size()), record.joints.count,
                              "joints of skin", i);
        comparison.checkEqual(skin.skeleton, static_cast<int32_t>(record.skeleton_root), "skeleton of skin",
                              i);
        if (skin.joints.size() != record.joints.count)
            continue;
        const SourceValues matrices =
            skin.inverseBindMatrices >= 0 ? readValues(source, skin.inverseBindMatrices) : SourceValues();
        for (size_t joint = 0; joint < skin.joints.size(); ++joint)
        {
            const formats::JointRecord& in_part = part.joints()[record.joints.first + joint];
            comparison.checkEqual(skin.joints[joint], in_part.node, "node of joint", joint);
            const SourceTransform matrix =
                matrices.values.empty() ? SourceTransform() : fromColumns(&matrices.values.at(joint * 16));
            compareTransform(Value::inverse_bind, matrix, in_part.joint_from_bind, 0, "of joint", joint,
                             comparison);
        }
    }
}

} // namespace hearth::test
