// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/scene.h"

#include "formats/base/scale_bound.h"
#include "pipelines/import/gltf/animations.h"
#include "pipelines/import/gltf/instancing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hearth::import
{

using namespace formats;

namespace
{

std::string nodePointer(uint32_t node)
{
    return fmt::format("/nodes/{}", node);
}

/// Return a flag for each node: true if it belongs to the scene that is drawn.
std::vector<bool> findDrawnNodes(const GltfModel& model, const GltfContext& context)
{
    std::vector<bool> drawn(model.nodes.size());
    if (model.scenes.empty())
    {
        drawn.assign(model.nodes.size(), true);
        return drawn;
    }
    const uint32_t scene = drawnScene(model);
    if (model.scenes.size() > 1)
        context.part.warn(
            Issue::dropped, "/scenes",
            fmt::format("scenes beside scene {} are not drawn: {}", scene, model.scenes.size() - 1));
    const std::string where = fmt::format("/scenes/{}", scene);
    std::vector<uint32_t> open;
    for (const uint32_t root : model.scenes[scene].nodes)
    {
        if (model.nodes[root].parent != kInvalidIndex)
            context.part.warn(Issue::repaired, where, fmt::format("node {} is not a root", root));
        open.push_back(root);
    }
    while (!open.empty())
    {
        const uint32_t node = open.back();
        open.pop_back();
        if (drawn[node])
            continue;
        drawn[node] = true;
        open.insert(open.end(), model.nodes[node].children.begin(), model.nodes[node].children.end());
    }
    return drawn;
}

class SceneWriter
{
public:
    SceneWriter(const GltfModel& model, const MeshUses& uses, std::span<const MeshSummary> meshes,
                GltfAccessors& accessors, const GltfContext& context, GltfTally& tally)
        : model_(model),
          uses_(uses),
          meshes_(meshes),
          accessors_(accessors),
          context_(context),
          tally_(tally),
          world_from_node_(worldTransforms(model))
    {
    }

    Status writeNode(uint32_t node);
    Status writeContents(uint32_t node);

    /// Write a shadow sphere, after the contents of all nodes: it refers to lights by name.
    Status writeShadowSphere(uint32_t node);

private:
    void writeMorphWeights(uint32_t node, NodeRecord& record);
    Status checkSkin(uint32_t node) const;
    Transform objectTransform(uint32_t node);
    Status writeInstances(uint32_t node);
    Status writeInstance(uint32_t node, const Transform& world_from_object);
    Status writeCamera(uint32_t node);
    Status writeLight(uint32_t node);
    std::vector<uint32_t> findLightsByName(const std::string& name) const;
    Result<Affine3> narrow(const Transform& transform, uint32_t node) const;

    const GltfModel& model_;
    const MeshUses& uses_;
    std::span<const MeshSummary> meshes_;
    GltfAccessors& accessors_;
    const GltfContext& context_;
    GltfTally& tally_;
    std::vector<Transform> world_from_node_;
};

Result<Affine3> SceneWriter::narrow(const Transform& transform, uint32_t node) const
{
    const std::optional<Affine3> result = narrowed(transform);
    if (result)
        return *result;
    double largest = 0;
    for (const auto& row : transform.m)
        for (const double number : row)
            largest = std::max(largest, std::abs(number));
    return context_.error(Issue::number_too_large, nodePointer(node),
                          fmt::format("its transform has the number {:g}, at most {:g} fits 32 bits", largest,
                                      std::numeric_limits<float>::max()));
}

void SceneWriter::writeMorphWeights(uint32_t node, NodeRecord& record)
{
    const size_t count = record.mesh == kInvalidIndex ? 0 : meshes_[record.mesh].morph_target_count;
    if (count == 0)
        return;
    const std::vector<float> weights = morphWeights(model_, node, count);
    record.morph_weights = {static_cast<uint32_t>(context_.part.morph_weights.size()),
                            static_cast<uint32_t>(count)};
    context_.part.morph_weights.insert(context_.part.morph_weights.end(), weights.begin(), weights.end());
}

Status SceneWriter::checkSkin(uint32_t node) const
{
    const GltfNode& n = model_.nodes[node];
    if (n.mesh == kInvalidIndex || n.skin == kInvalidIndex)
        return success();
    const size_t used = meshes_[uses_.of_node[node]].used_joints.size();
    if (used > model_.skins[n.skin].joints.size())
        return context_.error(Issue::gltf_data, nodePointer(node),
                              fmt::format("mesh {} uses joint {}, but skin {} has {} joints", n.mesh,
                                          used - 1, n.skin, model_.skins[n.skin].joints.size()));
    return success();
}

Status SceneWriter::writeNode(uint32_t node)
{
    const GltfNode& n = model_.nodes[node];
    HEARTH_TRY(checkSkin(node));
    NodeRecord record{};
    record.name = context_.part.intern(n.name);
    record.parent = n.parent;
    record.mesh = uses_.of_node[node];
    record.skin = record.mesh != kInvalidIndex && meshes_[record.mesh].skin == SkinState::usable
                      ? n.skin
                      : kInvalidIndex;
    record.has_trs = n.has_trs ? 1 : 0;
    record.translation = {n.translation[0], n.translation[1], n.translation[2]};
    record.rotation = {n.rotation[0], n.rotation[1], n.rotation[2], n.rotation[3]};
    record.scale = {n.scale[0], n.scale[1], n.scale[2]};
    HEARTH_ASSIGN_OR_RETURN(record.parent_from_node, narrow(n.parent_from_node, node));
    writeMorphWeights(node, record);
    context_.part.nodes.push_back(record);
    return success();
}

/// Return the transform of a node's instance. A skinned mesh is placed by its joints, so the node's own
/// transform does not count. The instance tells the winding of the triangles: it mirrors where the joints do.
Transform SceneWriter::objectTransform(uint32_t node)
{
    if (model_.nodes[node].skin == kInvalidIndex)
        return world_from_node_[node];
    const MeshSummary& mesh = meshes_[uses_.of_node[node]];
    switch (mesh.skin)
    {
    case SkinState::usable:
    {
        Transform reflection;
        reflection.m[0][0] = mesh.skin_mirrors ? -1 : 1;
        return reflection;
    }
    case SkinState::idle:
        tally_.degraded("a skin that does not move its mesh: the mesh is drawn where its node is",
                        nodePointer(node));
        break;
    case SkinState::too_large:
        tally_.degraded(
            "a skin whose rest pose does not fit 32-bit numbers: the mesh is drawn where its node is",
            nodePointer(node));
        break;
    }
    return world_from_node_[node];
}

Status SceneWriter::writeInstance(uint32_t node, const Transform& world_from_object)
{
    if (context_.part.instances.size() >= context_.options.limits.max_instances)
        return context_.error(Issue::input_too_large, nodePointer(node),
                              fmt::format("more than {} instances", context_.options.limits.max_instances));
    InstanceRecord record{};
    HEARTH_ASSIGN_OR_RETURN(record.world_from_object, narrow(world_from_object, node));
    record.mesh = uses_.of_node[node];
    record.node = node;
    record.flags = determinant(record.world_from_object) < 0 ? kInstanceMirrored : 0u;
    record.scale_max = scaleBound(record.world_from_object);
    context_.part.instances.push_back(record);
    return success();
}

Status SceneWriter::writeInstances(uint32_t node)
{
    const GltfNode& n = model_.nodes[node];
    if (n.mesh == kInvalidIndex || !meshes_[uses_.of_node[node]].has_triangles)
        return success();
    const Transform world_from_object = objectTransform(node);
    if (!n.has_instancing)
        return writeInstance(node, world_from_object);
    if (meshes_[uses_.of_node[node]].skin == SkinState::usable)
    {
        tally_.dropped("instancing of a skinned mesh is not kept: its joints place it", nodePointer(node));
        return writeInstance(node, world_from_object);
    }
    HEARTH_ASSIGN_OR_RETURN(const std::vector<Transform> copies,
                            readInstancing(n, node, accessors_, context_, tally_));
    for (const Transform& copy : copies)
        HEARTH_TRY(writeInstance(node, world_from_object * copy));
    return success();
}

Status SceneWriter::writeCamera(uint32_t node)
{
    if (model_.nodes[node].camera == kInvalidIndex)
        return success();
    const GltfCamera& camera = model_.cameras[model_.nodes[node].camera];
    CameraRecord record{};
    record.name = context_.part.intern(camera.name);
    record.type = static_cast<uint32_t>(camera.type);
    record.node = node;
    record.y_fov_rad = camera.y_fov_rad;
    record.aspect = camera.aspect;
    record.x_magnification = camera.x_magnification;
    record.y_magnification = camera.y_magnification;
    record.z_near = camera.z_near;
    record.z_far = camera.z_far;
    HEARTH_ASSIGN_OR_RETURN(record.world_from_camera, narrow(world_from_node_[node], node));
    context_.part.cameras.push_back(record);
    return success();
}

Status SceneWriter::writeLight(uint32_t node)
{
    if (model_.nodes[node].light == kInvalidIndex)
        return success();
    const GltfLight& light = model_.lights[model_.nodes[node].light];
    LightRecord record{};
    record.name = context_.part.intern(light.name);
    record.type = static_cast<uint32_t>(light.type);
    record.node = node;
    record.color = {light.color[0], light.color[1], light.color[2]};
    record.intensity = light.intensity;
    record.range = light.range;
    record.inner_cone_rad = light.inner_cone_rad;
    record.outer_cone_rad = light.outer_cone_rad;
    record.flicker_rate = light.flicker.rate;
    record.flicker_amplitude = light.flicker.amplitude;
    record.flicker_seed = light.flicker.seed;
    HEARTH_ASSIGN_OR_RETURN(record.world_from_light, narrow(world_from_node_[node], node));
    context_.part.lights.push_back(record);
    return success();
}

/// Return the lights that a sphere names, by their own name or their node's.
std::vector<uint32_t> SceneWriter::findLightsByName(const std::string& name) const
{
    const auto& lights = context_.part.lights;
    std::vector<uint32_t> found;
    for (uint32_t i = 0; i < lights.size(); ++i)
    {
        const GltfNode& node = model_.nodes[lights[i].node];
        if (node.name == name || model_.lights[node.light].name == name)
            found.push_back(i);
    }
    return found;
}

Status SceneWriter::writeShadowSphere(uint32_t node)
{
    const std::optional<GltfShadowSphere>& sphere = model_.nodes[node].shadow_sphere;
    if (!sphere)
        return success();
    HEARTH_ASSIGN_OR_RETURN(const Affine3 world_from_node, narrow(world_from_node_[node], node));
    ShadowSphereRecord record{};
    record.node = node;
    record.center = transformPoint(world_from_node, {0, 0, 0});
    record.radius = sphere->radius * scaleBound(world_from_node);
    record.texels = sphere->texels;
    if (!(record.radius > 0) || !std::isfinite(record.radius))
        return context_.error(Issue::gltf_extension_value, nodePointer(node),
                              "the shadow sphere has no size in the world");
    std::vector<uint32_t> lights{kInvalidIndex};
    if (!sphere->light.empty())
        lights = findLightsByName(sphere->light);
    if (lights.empty())
        context_.part.warn(
            Issue::dropped, nodePointer(node),
            fmt::format("no light is called \"{}\": the shadow sphere is not kept", sphere->light));
    for (const uint32_t light : lights)
    {
        record.light = light;
        context_.part.shadow_spheres.push_back(record);
    }
    return success();
}

Status SceneWriter::writeContents(uint32_t node)
{
    HEARTH_TRY(writeInstances(node));
    HEARTH_TRY(writeCamera(node));
    return writeLight(node);
}

} // namespace

std::vector<float> morphWeights(const GltfModel& model, uint32_t node, size_t count)
{
    const GltfNode& n = model.nodes[node];
    std::vector<float> weights = n.weights.empty() ? model.meshes[n.mesh].weights : n.weights;
    weights.resize(count);
    return weights;
}

Status writeScene(const GltfModel& model, const MeshUses& uses, std::span<const MeshSummary> meshes,
                  const std::vector<bool>& hidden, GltfAccessors& accessors, const GltfContext& context,
                  GltfTally& tally)
{
    const std::vector<bool> drawn = findDrawnNodes(model, context);
    SceneWriter writer(model, uses, meshes, accessors, context, tally);
    for (uint32_t node = 0; node < model.nodes.size(); ++node)
        HEARTH_TRY(writer.writeNode(node));
    for (uint32_t node = 0; node < model.nodes.size(); ++node)
        if (drawn[node] && !hidden[node])
            HEARTH_TRY(writer.writeContents(node));
    for (uint32_t node = 0; node < model.nodes.size(); ++node)
        if (drawn[node] && !hidden[node])
            HEARTH_TRY(writer.writeShadowSphere(node));
    return success();
}

} // namespace hearth::import
