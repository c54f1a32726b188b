// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/c/camera.h"
#include "runtime/c/tables.h"
#include "runtime/pack/queries/clip_bounds.h"

#include <algorithm>
#include <cmath>

using namespace hearth;
using namespace hearth::c;

namespace
{

Affine3 toAffine(const float (&rows)[3][4])
{
    Affine3 transform;
    static_assert(sizeof(transform.m) == sizeof(rows));
    std::copy_n(&rows[0][0], 12, &transform.m[0][0]);
    return transform;
}

Result<pack::InstancePose> toPose(const hearth_pose& pose)
{
    if ((pose.joint_count > 0 && pose.world_from_bind == nullptr) ||
        (pose.morph_weight_count > 0 && pose.morph_weights == nullptr))
        return usage("world_from_bind or morph_weights of a pose is NULL");
    static_assert(sizeof(hearth_transform) == sizeof(Affine3d));
    return pack::InstancePose{{pose.instance,
                               {reinterpret_cast<const Affine3d*>(pose.world_from_bind), pose.joint_count},
                               {pose.morph_weights, pose.morph_weight_count}},
                              pose.is_free != 0};
}

Status place(pack::SceneQueries& queries, std::span<const hearth_move> moves,
             std::span<const hearth_pose> poses)
{
    for (const hearth_move& move : moves)
        HEARTH_TRY(queries.states().checkMove(move.instance, toAffine(move.world_from_object)));
    for (const hearth_pose& pose : poses)
    {
        HEARTH_ASSIGN_OR_RETURN(const pack::InstancePose checked, toPose(pose));
        HEARTH_TRY(queries.states().checkPose(checked));
    }
    for (const hearth_move& move : moves)
        queries.move(move.instance, toAffine(move.world_from_object));
    for (const hearth_pose& pose : poses)
        queries.pose(*toPose(pose));
    return success();
}

/// Convert a point of a ray's hit; a null one is none.
hearth_hit toHit(const formats::PackView& view, const pack::SurfacePoint* point)
{
    hearth_hit hit{};
    hit.instance = kInvalidIndex;
    if (point == nullptr)
        return hit;
    const formats::InstanceRecord& instance = view.instances()[point->id.instance];
    hit.instance = point->id.instance;
    hit.node = instance.node;
    hit.mesh = instance.mesh;
    hit.material = view.clusters()[point->id.cluster].material;
    hit.cluster = point->id.cluster;
    hit.triangle = point->id.triangle;
    hit.t = static_cast<float>(point->t);
    for (size_t i = 0; i < 2; ++i)
        hit.weights[i] = static_cast<float>(point->weights[i]);
    const Float3 position = narrow(point->position), normal = narrow(point->normal);
    for (int axis = 0; axis < 3; ++axis)
    {
        hit.position[axis] = position[axis];
        hit.normal[axis] = normal[axis];
    }
    return hit;
}

hearth_box toC(const Box3& box)
{
    return {{box.min.x, box.min.y, box.min.z}, {box.max.x, box.max.y, box.max.z}};
}

Status checkInstances(const hearth_pack& pack, uint32_t first, uint32_t count)
{
    const size_t instances = pack.pack.view().instances().size();
    if (!formats::isInsideTable({first, count}, instances))
        return usage("there are no " + std::to_string(count) + " instances from " + std::to_string(first) +
                     " on: the pack has " + std::to_string(instances));
    return success();
}

Result<pack::Ray> toRay(const hearth_ray& ray)
{
    const Float3 origin = toFloat3(ray.origin), direction = toFloat3(ray.direction);
    if (!isFinite(origin) || !isFinite(direction) || direction == Float3{})
        return usage("the origin or the direction of a ray is not finite, or its direction is 0");
    if (!(ray.t_min >= 0) || !std::isfinite(ray.t_min) || !(ray.t_max >= ray.t_min))
        return usage("t_min of a ray is below 0, or t_max below t_min");
    return pack::Ray{widen(origin), widen(direction), ray.t_min, ray.t_max};
}

Result<pack::CastOptions> toOptions(const hearth_queries& queries, const hearth_cast* cast)
{
    pack::CastOptions options;
    if (cast == nullptr)
        return options;
    HEARTH_TRY(checkStruct("cast", cast));
    if ((cast->flags & ~uint32_t{HEARTH_CAST_ANY | HEARTH_CAST_FRONT_SIDES}) != 0)
        return usage("the flags of cast have a bit that this version does not know");
    options.any_hit = (cast->flags & HEARTH_CAST_ANY) != 0;
    options.culls_back = (cast->flags & HEARTH_CAST_FRONT_SIDES) != 0;
    if (cast->scene != nullptr && cast->scene->pack != &queries.pack)
        return usage("the scene is of another pack");
    if (cast->scene != nullptr && cast->scene->scene->stream != nullptr)
        options.resident = &cast->scene->scene->stream->pages().groups();
    if (cast->accept != nullptr)
        options.accept = [&queries, cast](const pack::SurfacePoint& point)
        {
            const hearth_hit hit = toHit(queries.pack.pack.view(), &point);
            return cast->accept(cast->user, &hit) != 0;
        };
    return options;
}

} // namespace

hearth_result hearth_queries_create(hearth_pack* pack, const hearth_queries_options* options,
                                    hearth_queries** queries, char* message, size_t message_size)
{
    return call({message, message_size}, __func__,
                [&]() -> Status
                {
                    if (pack == nullptr || queries == nullptr)
                        return usage("pack or queries is NULL");
                    HEARTH_TRY(checkStruct("options", options));
                    if (options->reserved != 0)
                        return usage("reserved is not 0");
                    *queries = new hearth_queries(*pack, options->page_bytes);
                    ++pack->queries_count;
                    return success();
                });
}

hearth_result hearth_queries_destroy(hearth_queries* queries)
{
    if (queries != nullptr)
        --queries->pack.queries_count;
    delete queries;
    return HEARTH_OK;
}

hearth_result hearth_queries_place(hearth_queries* queries, const hearth_move* moves, uint32_t move_count,
                                   const hearth_pose* poses, uint32_t pose_count, char* message,
                                   size_t message_size)
{
    return call({message, message_size}, __func__,
                [&]() -> Status
                {
                    if (queries == nullptr || (moves == nullptr && move_count > 0) ||
                        (poses == nullptr && pose_count > 0))
                        return usage("queries, moves or poses is NULL");
                    return place(queries->queries, {moves, move_count}, {poses, pose_count});
                });
}

hearth_result hearth_queries_get_bounds(const hearth_queries* queries, uint32_t first, uint32_t count,
                                        hearth_box* box, char* message, size_t message_size)
{
    return call({message, message_size}, __func__,
                [&]() -> Status
                {
                    if (queries == nullptr || box == nullptr)
                        return usage("queries or box is NULL");
                    HEARTH_TRY(checkInstances(queries->pack, first, count));
                    *box = toC(queries->queries.bounds(first, count));
                    return success();
                });
}

hearth_result hearth_pack_get_clip_bounds(const hearth_pack* pack, uint32_t animation, uint32_t first,
                                          uint32_t count, hearth_box* box, char* message, size_t message_size)
{
    return call({message, message_size}, __func__,
                [&]() -> Status
                {
                    HEARTH_TRY(checkRecord(pack, HEARTH_TABLE_ANIMATIONS, animation));
                    HEARTH_TRY(checkInstances(*pack, first, count));
                    if (box == nullptr)
                        return usage("box is NULL");
                    *box = toC(pack::clipBounds(pack->pack.view(), animation, {first, count}));
                    return success();
                });
}

hearth_result hearth_queries_cast_rays(hearth_queries* queries, const hearth_ray* rays, uint32_t ray_count,
                                       const hearth_cast* cast, hearth_hit* hits, char* message,
                                       size_t message_size)
{
    return call({message, message_size}, __func__,
                [&]() -> Status
                {
                    if (queries == nullptr || (ray_count > 0 && (rays == nullptr || hits == nullptr)))
                        return usage("queries, rays or hits is NULL");
                    HEARTH_ASSIGN_OR_RETURN(const pack::CastOptions options, toOptions(*queries, cast));
                    for (uint32_t i = 0; i < ray_count; ++i)
                    {
                        HEARTH_ASSIGN_OR_RETURN(const pack::Ray ray, toRay(rays[i]));
                        HEARTH_ASSIGN_OR_RETURN(const auto point, queries->queries.cast(ray, options));
                        hits[i] = toHit(queries->pack.pack.view(), point ? &*point : nullptr);
                    }
                    return success();
                });
}

hearth_result hearth_queries_find_pick(hearth_queries* queries, const hearth_frame* frame, uint32_t width,
                                       uint32_t height, uint32_t x, uint32_t y, const hearth_pick* pick,
                                       hearth_hit* hit, char* message, size_t message_size)
{
    return call({message, message_size}, __func__,
                [&]() -> Status
                {
                    if (queries == nullptr || pick == nullptr || hit == nullptr)
                        return usage("queries, pick or hit is NULL");
                    HEARTH_TRY(checkStruct("frame", frame));
                    HEARTH_ASSIGN_OR_RETURN(const hearth_ray ray,
                                            makePixelRay(*frame, width, height, static_cast<float>(x) + 0.5f,
                                                         static_cast<float>(y) + 0.5f));
                    const formats::PackView& view = queries->pack.pack.view();
                    if (pick->instance == kInvalidIndex)
                    {
                        *hit = toHit(view, nullptr);
                        return success();
                    }
                    HEARTH_ASSIGN_OR_RETURN(const pack::Ray checked, toRay(ray));
                    HEARTH_ASSIGN_OR_RETURN(
                        const pack::SurfacePoint point,
                        queries->queries.findPoint({pick->instance, pick->cluster, pick->triangle}, checked));
                    *hit = toHit(view, &point);
                    return success();
                });
}
