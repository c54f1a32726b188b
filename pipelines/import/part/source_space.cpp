// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/part/source_space.h"

#include "formats/base/scale_bound.h"
#include "formats/scene/animation.h"

#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <set>

namespace hearth::import
{

using namespace formats;

namespace
{

Affine3d rotationFromUpAxis(UpAxis up)
{
    Affine3d turn;
    if (up == UpAxis::z)
    {
        turn.m[1][1] = 0;
        turn.m[1][2] = 1;
        turn.m[2][1] = -1;
        turn.m[2][2] = 0;
    }
    return turn;
}

Affine3d scaled(Affine3d transform, double factor)
{
    for (auto& row : transform.m)
        for (double& entry : row)
            entry *= factor;
    return transform;
}

std::vector<Affine3d> computeRestTransforms(std::span<const NodeRecord> nodes)
{
    AnimationTables tables;
    tables.nodes = nodes;
    std::vector<Affine3d> world_from_node(nodes.size());
    poseNodes(tables, restPose(tables), nodesParentsFirst(nodes), world_from_node);
    return world_from_node;
}

/// Converts everything in a part that has a place in the world.
class SpaceConverter
{
public:
    SpaceConverter(const SourceSpace& space, PartBuilder& part)
        : factor_(space.metres_per_unit),
          rotation_(rotationFromUpAxis(space.up)),
          world_from_source_(scaled(rotation_, factor_)),
          part_(part)
    {
    }

    Status move()
    {
        const std::vector<Affine3d> before = computeRestTransforms(part_.nodes);
        HEARTH_TRY(addRoot());
        const std::vector<Affine3d> after = computeRestTransforms(part_.nodes);
        for (InstanceRecord& instance : part_.instances)
            HEARTH_TRY(convertInstance(instance, before, after));
        for (CameraRecord& camera : part_.cameras)
            HEARTH_TRY(convertCamera(camera));
        for (LightRecord& light : part_.lights)
            HEARTH_TRY(convertLight(light));
        HEARTH_TRY(convertLightRanges());
        for (ShadowSphereRecord& sphere : part_.shadow_spheres)
            HEARTH_TRY(convertSphere(sphere));
        if (part_.sky)
            part_.sky->world_from_cube = rotation_ * part_.sky->world_from_cube;
        return success();
    }

private:
    Error outOfRangeError() const
    {
        return {
            Issue::input_too_large, part_.sourceName(), "",
            fmt::format("scaled by {}, a place or a length does not fit 32-bit numbers, which are up to {:g}",
                        factor_, std::numeric_limits<float>::max())};
    }

    Result<Affine3> narrow(const Affine3d& transform) const
    {
        const std::optional<Affine3> result = narrowed(transform);
        return result ? Result<Affine3>(*result) : outOfRangeError();
    }

    /// Scale a length. 0 means no limit and stays 0; no other length may become 0.
    Status scaleLength(float& length) const
    {
        const auto metres = static_cast<float>(double{length} * factor_);
        if (!std::isfinite(metres) || (metres == 0) != (length == 0))
            return outOfRangeError();
        length = metres;
        return success();
    }

    Status addRoot()
    {
        NodeRecord root{};
        root.parent = root.mesh = root.skin = kInvalidIndex;
        root.rotation = {0, 0, 0, 1};
        root.scale = {1, 1, 1};
        HEARTH_ASSIGN_OR_RETURN(root.parent_from_node, narrow(world_from_source_));
        const auto index = static_cast<uint32_t>(part_.nodes.size());
        for (NodeRecord& node : part_.nodes)
            if (node.parent == kInvalidIndex)
                node.parent = index;
        part_.nodes.push_back(root);
        return success();
    }

    /// Move an instance. An instance whose transform equals its node's must equal it bit by bit afterwards:
    /// the runtime concludes from equality that nothing lies between them. A skinned instance is placed by
    /// its joints, which have moved already.
    Status convertInstance(InstanceRecord& instance, std::span<const Affine3d> before,
                           std::span<const Affine3d> after)
    {
        if (part_.nodes[instance.node].skin != kInvalidIndex)
            return success();
        const bool equals_node = narrowed(before[instance.node]) == instance.world_from_object;
        HEARTH_ASSIGN_OR_RETURN(instance.world_from_object,
                                narrow(equals_node
                                           ? after[instance.node]
                                           : world_from_source_ * widened(instance.world_from_object)));
        instance.scale_max = scaleBound(instance.world_from_object);
        return success();
    }

    /// Return the transform of a camera or light, rotated and moved without a change to the length of its
    /// axes: its own lengths are scaled separately.
    Result<Affine3> convertTransform(const Affine3& world_from_local) const
    {
        Affine3d place = rotation_ * widened(world_from_local);
        for (auto& row : place.m)
            row[3] *= factor_;
        return narrow(place);
    }

    Status convertCamera(CameraRecord& camera)
    {
        HEARTH_ASSIGN_OR_RETURN(camera.world_from_camera, convertTransform(camera.world_from_camera));
        for (float* length :
             {&camera.z_near, &camera.z_far, &camera.x_magnification, &camera.y_magnification})
            HEARTH_TRY(scaleLength(*length));
        return success();
    }

    Status convertLight(LightRecord& light)
    {
        HEARTH_ASSIGN_OR_RETURN(light.world_from_light, convertTransform(light.world_from_light));
        return scaleLength(light.range);
    }

    /// Scale the animated ranges of lights. Channels may share their keys.
    Status convertLightRanges()
    {
        std::set<uint32_t> converted;
        for (const AnimationChannelRecord& channel : part_.channels)
        {
            if (channel.path != static_cast<uint32_t>(AnimationPath::light_range) ||
                !converted.insert(channel.first_value).second)
                continue;
            const bool spline = channel.interpolation == static_cast<uint32_t>(Interpolation::cubic_spline);
            for (float& length :
                 std::span(part_.keys).subspan(channel.first_value, channel.key_count * (spline ? 3u : 1u)))
                HEARTH_TRY(scaleLength(length));
        }
        return success();
    }

    Status convertSphere(ShadowSphereRecord& sphere)
    {
        const Double3 center = transformPoint(world_from_source_, widen(sphere.center));
        if (!isFinite(hearth::narrow(center)))
            return outOfRangeError();
        sphere.center = hearth::narrow(center);
        return scaleLength(sphere.radius);
    }

    const double factor_;
    const Affine3d rotation_;
    const Affine3d world_from_source_;
    PartBuilder& part_;
};

} // namespace

Status convertToMetres(const SourceSpace& space, PartBuilder& part)
{
    if (space.metres_per_unit == 1 && space.up == UpAxis::y)
        return success();
    return SpaceConverter(space, part).move();
}

} // namespace hearth::import
