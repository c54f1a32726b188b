// Checks nodes, instances, cameras, lights and shadow spheres.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/pack/check_tools.h"
#include "formats/pack/pack_check.h"

#include <numbers>

namespace hearth::formats::check
{

namespace
{

// pi rounded up to a float, plus one unit in the last place for a writer's conversion from degrees
constexpr float kStraightAngle = 3.1415930f;

bool unitQuaternion(Float4 q)
{
    const double length =
        std::sqrt(double{q.x} * q.x + double{q.y} * q.y + double{q.z} * q.z + double{q.w} * q.w);
    return std::abs(length - 1.0) <= kUnitSlack;
}

Status checkNode(const PackView& view, size_t i)
{
    const NodeRecord& node = view.nodes()[i];
    if (!isNoneOrBelow(node.parent, view.nodes().size()))
        return makeError(view, Issue::meaning_reference, "node", i, "parent " + std::to_string(node.parent));
    if (!isNoneOrBelow(node.skin, view.skins().size()))
        return makeError(view, Issue::meaning_reference, "node", i, "skin " + std::to_string(node.skin));
    if (!isInsideTable(node.morph_weights, view.morphWeights().size()))
        return makeError(view, Issue::meaning_range, "node", i, "its morph weights lie outside chunk MWGT");
    if (node.has_trs > 1)
        return makeError(view, Issue::meaning_value, "node", i, "has_trs " + std::to_string(node.has_trs));
    if (!finite(node.translation) || !finite(node.rotation) || !finite(node.scale) ||
        !finite(node.parent_from_node))
        return makeError(view, Issue::meaning_value, "node", i, "its transform is not finite");
    if (node.has_trs == 1 && !unitQuaternion(node.rotation))
        return makeError(view, Issue::meaning_value, "node", i, "its rotation is not a unit quaternion");
    return success();
}

Status checkMeshOfNode(const PackView& view, size_t i)
{
    const NodeRecord& node = view.nodes()[i];
    if (!isNoneOrBelow(node.mesh, view.meshes().size()))
        return makeError(view, Issue::meaning_reference, "node", i, "mesh " + std::to_string(node.mesh));
    const uint32_t targets = node.mesh == kInvalidIndex ? 0 : view.meshes()[node.mesh].morph_target_count;
    // one weight for each target also keeps the number of targets plausible
    if (node.morph_weights.count != targets)
        return makeError(view, Issue::meaning_value, "node", i,
                         std::to_string(node.morph_weights.count) + " morph weights for " +
                             std::to_string(targets) + " targets");
    return success();
}

/// Check that the path up from every node ends at a root. Each node is visited once.
Status checkTree(const PackView& view)
{
    const std::span<const NodeRecord> nodes = view.nodes();
    std::vector<size_t> walk_of_node(nodes.size(), 0); // 0: not seen; walks count from 1
    for (size_t start = 0; start < nodes.size(); ++start)
    {
        size_t node = start;
        while (walk_of_node[node] == 0)
        {
            walk_of_node[node] = start + 1;
            if (nodes[node].parent == kInvalidIndex)
                break;
            node = nodes[node].parent;
            if (walk_of_node[node] == start + 1)
                return makeError(view, Issue::meaning_tree, "node", node, "it is its own ancestor");
        }
    }
    return success();
}

/// Return a lower bound of the largest factor by which a transform stretches, tight to a part in a thousand
/// or better.
double lowerStretchBound(const Affine3& t)
{
    double best = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
        // power iteration on A^T A; every step gives a lower bound, so slow convergence only makes the check
        // less strict
        double v[3] = {axis == 0 ? 1.0 : 0.1, axis == 1 ? 1.0 : 0.2, axis == 2 ? 1.0 : 0.3};
        for (int step = 0; step < 8; ++step)
        {
            double image[3];
            for (int row = 0; row < 3; ++row)
                image[row] = t.m[row][0] * v[0] + t.m[row][1] * v[1] + t.m[row][2] * v[2];
            const double in = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
            const double out = std::sqrt(image[0] * image[0] + image[1] * image[1] + image[2] * image[2]);
            if (!(in > 0) || !(out > 0))
                break;
            best = std::max(best, out / in);
            for (int column = 0; column < 3; ++column)
                v[column] =
                    (t.m[0][column] * image[0] + t.m[1][column] * image[1] + t.m[2][column] * image[2]) /
                    (out * out);
        }
    }
    return best;
}

/// Return +1, -1, or 0 if the determinant is too close to zero for its sign to be reliable in floats.
int orientation(const Affine3& t)
{
    const auto row = [&](int i) { return std::array<double, 3>{t.m[i][0], t.m[i][1], t.m[i][2]}; };
    const auto a = row(0), b = row(1), c = row(2);
    const auto norm = [](const std::array<double, 3>& r) { return std::hypot(r[0], r[1], r[2]); };
    const double det = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
                       a[2] * (b[0] * c[1] - b[1] * c[0]);
    const double volume = norm(a) * norm(b) * norm(c);
    if (!(std::abs(det) > 1e-5 * volume) || !(std::abs(det) > std::numeric_limits<float>::min()))
        return 0;
    return det < 0 ? -1 : 1;
}

Status checkInstance(const PackView& view, size_t i)
{
    const InstanceRecord& instance = view.instances()[i];
    if (instance.mesh >= view.meshes().size())
        return makeError(view, Issue::meaning_reference, "instance", i,
                         "mesh " + std::to_string(instance.mesh));
    if (instance.node >= view.nodes().size())
        return makeError(view, Issue::meaning_reference, "instance", i,
                         "node " + std::to_string(instance.node));
    if (!finite(instance.world_from_object) || !isNonNegative(instance.scale_max))
        return makeError(view, Issue::meaning_value, "instance", i, "its transform is not finite");
    if ((instance.flags & ~uint32_t{kInstanceMirrored}) != 0)
        return makeError(view, Issue::meaning_value, "instance", i,
                         "flags " + std::to_string(instance.flags));
    const int turned = orientation(instance.world_from_object);
    if (turned != 0 && (turned < 0) != ((instance.flags & kInstanceMirrored) != 0))
        return makeError(view, Issue::meaning_value, "instance", i,
                         "the flag for a mirrored instance is wrong");
    if (lowerStretchBound(instance.world_from_object) > instance.scale_max * (1 + kSphereSlack))
        return makeError(view, Issue::meaning_bounds, "instance", i,
                         "scale_max is less than the transform stretches");
    return success();
}

bool validPerspective(const CameraRecord& camera)
{
    return camera.y_fov_rad > 0 && camera.y_fov_rad < kStraightAngle && isNonNegative(camera.aspect) &&
           camera.z_near > 0 && (camera.z_far == 0 || camera.z_far > camera.z_near);
}

bool validOrthographic(const CameraRecord& camera)
{
    return camera.x_magnification != 0 && camera.y_magnification != 0 && camera.z_near >= 0 &&
           camera.z_far > camera.z_near;
}

bool validFlicker(const LightRecord& light)
{
    if (light.flicker_rate == 0)
        return light.flicker_amplitude == 0 && light.flicker_seed == 0;
    return isNonNegative(light.flicker_rate) && inside(light.flicker_amplitude, 0, 1);
}

} // namespace

Status checkNodeTree(const PackView& view)
{
    if (!finite(view.morphWeights()))
        return Error{Issue::meaning_value, view.name(), chunkName(kChunkMorphWeights, 0),
                     "a weight is not finite"};
    for (size_t i = 0; i < view.nodes().size(); ++i)
        HEARTH_TRY(checkNode(view, i));
    return checkTree(view);
}

Status checkNodeMeshes(const PackView& view)
{
    for (size_t i = 0; i < view.nodes().size(); ++i)
        HEARTH_TRY(checkMeshOfNode(view, i));
    return success();
}

Status checkInstances(const PackView& view)
{
    for (size_t i = 0; i < view.instances().size(); ++i)
        HEARTH_TRY(checkInstance(view, i));
    return success();
}

Status checkCameras(const PackView& view)
{
    for (size_t i = 0; i < view.cameras().size(); ++i)
    {
        const CameraRecord& camera = view.cameras()[i];
        if (camera.node >= view.nodes().size())
            return makeError(view, Issue::meaning_reference, "camera", i,
                             "node " + std::to_string(camera.node));
        if (camera.type > static_cast<uint32_t>(CameraType::orthographic))
            return makeError(view, Issue::meaning_value, "camera", i, "type " + std::to_string(camera.type));
        const float lens[] = {camera.y_fov_rad,       camera.aspect, camera.x_magnification,
                              camera.y_magnification, camera.z_near, camera.z_far};
        if (!finite(camera.world_from_camera) || !finite(lens))
            return makeError(view, Issue::meaning_value, "camera", i, "a value is not finite");
        const bool perspective = camera.type == static_cast<uint32_t>(CameraType::perspective);
        if (!(perspective ? validPerspective(camera) : validOrthographic(camera)))
            return makeError(view, Issue::meaning_value, "camera", i, "its lens is not possible");
    }
    return success();
}

Status checkLights(const PackView& view)
{
    for (size_t i = 0; i < view.lights().size(); ++i)
    {
        const LightRecord& light = view.lights()[i];
        if (light.node >= view.nodes().size())
            return makeError(view, Issue::meaning_reference, "light", i,
                             "node " + std::to_string(light.node));
        if (light.type > static_cast<uint32_t>(LightType::spot))
            return makeError(view, Issue::meaning_value, "light", i, "type " + std::to_string(light.type));
        if (!isNonNegative(light.color.x) || !isNonNegative(light.color.y) || !isNonNegative(light.color.z) ||
            !isNonNegative(light.intensity) || !isNonNegative(light.range) || !finite(light.world_from_light))
            return makeError(view, Issue::meaning_value, "light", i, "a value is negative or not finite");
        if (!inside(light.inner_cone_rad, 0, kRightAngle) ||
            !inside(light.outer_cone_rad, light.inner_cone_rad, kRightAngle))
            return makeError(view, Issue::meaning_value, "light", i, "its cone is not possible");
        if (!validFlicker(light))
            return makeError(view, Issue::meaning_value, "light", i, "its flicker is not possible");
    }
    return success();
}

Status checkShadowSpheres(const PackView& view)
{
    constexpr const char* kKind = "shadow sphere";
    for (size_t i = 0; i < view.shadowSpheres().size(); ++i)
    {
        const ShadowSphereRecord& sphere = view.shadowSpheres()[i];
        if (sphere.node >= view.nodes().size())
            return makeError(view, Issue::meaning_reference, kKind, i, "node " + std::to_string(sphere.node));
        if (!isNoneOrBelow(sphere.light, view.lights().size()))
            return makeError(view, Issue::meaning_reference, kKind, i,
                             "light " + std::to_string(sphere.light));
        const float values[] = {sphere.center.x, sphere.center.y, sphere.center.z, sphere.radius};
        if (!finite(values) || !(sphere.radius > 0))
            return makeError(view, Issue::meaning_value, kKind, i, "its centre or radius is not possible");
        if (sphere.texels != 0 && !isShadowMapSize(sphere.texels))
            return makeError(view, Issue::meaning_value, kKind, i, std::to_string(sphere.texels) + " texels");
        if (sphere.reserved != 0)
            return makeError(view, Issue::meaning_padding, kKind, i, "a reserved field is not 0");
    }
    return success();
}

} // namespace hearth::formats::check
