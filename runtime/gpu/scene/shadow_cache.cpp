// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/scene/shadow_cache.h"

#include "formats/base/assert.h"
#include "runtime/frame/frame.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hearth::gpu
{

namespace
{

// covers what is rounded when a reach is added
constexpr float kGrown = 1.001f;

// below all errors, which can be 0
constexpr float kUnchanged = -1;

Box3 worldBox(const Box3& box, const Affine3& world_from_object)
{
    Box3 world;
    if (!box.empty())
        for (int corner = 0; corner < 8; ++corner)
            world.add(transformPoint(world_from_object, {(corner & 1) != 0 ? box.max.x : box.min.x,
                                                         (corner & 2) != 0 ? box.max.y : box.min.y,
                                                         (corner & 4) != 0 ? box.max.z : box.min.z}));
    return world;
}

Affine3 readTransform(const shared::Instance& instance)
{
    Affine3 t;
    const Float4 rows[] = {instance.world_from_object_x, instance.world_from_object_y,
                           instance.world_from_object_z};
    for (size_t row = 0; row < 3; ++row)
    {
        t.m[row][0] = rows[row].x;
        t.m[row][1] = rows[row].y;
        t.m[row][2] = rows[row].z;
        t.m[row][3] = rows[row].w;
    }
    return t;
}

/// Return the boxes of the proxies that cast the shadows of meshes, empty for others.
std::vector<Box3> findProxyBoxes(const formats::PackView& pack, Casters casters)
{
    return casters == Casters::proxies ? shared::findProxyCasters(pack).boxes
                                       : std::vector<Box3>(pack.meshes().size());
}

/// Bounds of a mesh's clusters and of the spheres that decide its cut, or of the proxy that casts its shadow.
/// motions  VertexMotions::reaches
std::vector<Box3> computeReaches(const formats::PackView& pack, std::span<const Box3> proxy_boxes,
                                 std::span<const float> motions)
{
    std::vector<Box3> reaches;
    for (const shared::MeshBounds& bounds : shared::makeMeshBounds(pack.meshes(), pack.clusters()))
        reaches.push_back({bounds.box_min, bounds.box_max});
    for (const formats::DeformedMeshRecord& mesh : pack.deformedMeshes())
        reaches[mesh.mesh] = {mesh.box_min, mesh.box_max};
    for (size_t mesh = 0; mesh < reaches.size(); ++mesh)
        for (const formats::GroupRecord& group :
             formats::recordsInRange(pack.groups(), pack.meshes()[mesh].groups))
        {
            const Float3 reach = Float3{1, 1, 1} * group.sphere_radius;
            reaches[mesh].add(group.sphere_center - reach);
            reaches[mesh].add(group.sphere_center + reach);
        }
    for (size_t mesh = 0; mesh < motions.size(); ++mesh)
        if (const Float3 motion = Float3{1, 1, 1} * (motions[mesh] * kGrown); !reaches[mesh].empty())
            reaches[mesh] = {reaches[mesh].min - motion, reaches[mesh].max + motion};
    for (size_t mesh = 0; mesh < reaches.size(); ++mesh)
        if (!proxy_boxes[mesh].empty())
            reaches[mesh] = proxy_boxes[mesh];
    return reaches;
}

bool intersects(const shared::FrameView& casters, const Box3& box)
{
    shared::Instance unmoved{};
    unmoved.world_from_object_x.x = unmoved.world_from_object_y.y = unmoved.world_from_object_z.z = 1;
    return !box.empty() && !shared::boxOutsideFrustum(casters, unmoved, box.min, box.max);
}

/// True if an error somewhere in the box may exceed the threshold. It is largest at the nearest point of the
/// box, also under a distance curve, which grows no faster than the distance.
bool mayExceed(const shared::FrameView& casters, const Box3& box, float error_world)
{
    const auto outside = [](float at, float low, float high) {
        return std::max({low - at, at - high, 0.0f});
    };
    const Float3 offset{outside(casters.eye.x, box.min.x, box.max.x),
                        outside(casters.eye.y, box.min.y, box.max.y),
                        outside(casters.eye.z, box.min.z, box.max.z)};
    constexpr float kRounding = 1.001f;
    const float distance =
        shared::isOrthographic(casters) ? 1 : std::max(length(offset) / kRounding, casters.z_near);
    return error_world * kRounding * casters.lod_scale * shared::lodFactor(casters, distance) >
           casters.threshold * distance;
}

/// Return the light without the members that do not affect the depth in its maps.
shared::ShadowLight projectionKey(shared::ShadowLight light)
{
    light.first_map = light.map_count = 0;
    return light;
}

/// Return the view without the members that do not affect which casters it finds.
shared::FrameView cullingKey(shared::FrameView casters)
{
    casters.clip_x = casters.clip_y = casters.clip_w = {};
    casters.width = casters.height = 0;
    casters.material_inputs = {}; // disturb() says what follows them
    return casters;
}

/// Compare records without padding: equal bits decide equally.
template <typename T>
bool sameBits(const T& a, const T& b)
{
    const auto first = std::as_bytes(std::span(&a, 1));
    const auto second = std::as_bytes(std::span(&b, 1));
    return std::equal(first.begin(), first.end(), second.begin());
}

} // namespace

ShadowCache::ShadowCache(const formats::PackView& pack, const ShadowOptions& options,
                         std::span<const float> reaches)
    : pack_(pack),
      proxy_boxes_(findProxyBoxes(pack, options.casters)),
      mesh_bounds_(computeReaches(pack, proxy_boxes_, reaches)),
      changed_errors_(pack.meshes().size(), kUnchanged),
      has_moved_(pack.instances().size(), 0),
      moving_layers_(options.moving_layers),
      layers_(options.max_maps)
{
    for (const formats::InstanceRecord& instance : pack.instances())
    {
        mesh_of_instance_.push_back(instance.mesh);
        instance_scales_.push_back(instance.scale_max);
        follows_eye_ = follows_eye_ || proxy_boxes_[instance.mesh].empty();
        instance_bounds_.push_back(worldBox(mesh_bounds_[instance.mesh], instance.world_from_object));
    }
    movers_.reserve(pack.instances().size());
    wanted_.reserve(options.max_maps);
    stale_.reserve(2 * size_t{options.max_maps});
}

void ShadowCache::move(std::span<const InstanceMove> moves)
{
    for (const InstanceMove& move : moves)
        place(move.instance,
              worldBox(mesh_bounds_[mesh_of_instance_[move.instance]], readTransform(move.record)),
              move.record.scale_max);
}

void ShadowCache::disturb(std::span<const uint32_t> instances)
{
    for (const uint32_t instance : instances)
        place(instance, Box3(instance_bounds_[instance]), instance_scales_[instance]);
}

void ShadowCache::pose(const DeformedInstance& instance, const PoseRows& rows)
{
    Box3 reach = mesh_bounds_[mesh_of_instance_[instance.instance]];
    if (const auto sphere = freeSphere(rows))
    {
        const Float3 radius = Float3{1, 1, 1} * sphere->radius;
        reach = {sphere->center - radius, sphere->center + radius};
    }
    place(instance.instance, worldBox(reach, readTransform(rows.record)), rows.record.scale_max);
}

/// Move the bounds of an instance, and invalidate the maps that intersect its old or new bounds.
void ShadowCache::place(uint32_t instance, const Box3& box, float scale)
{
    invalidate(instance_bounds_[instance], has_moved_[instance] != 0);
    if (moving_layers_ && has_moved_[instance] == 0)
    {
        has_moved_[instance] = 1;
        movers_.push_back(instance);
    }
    instance_bounds_[instance] = box;
    invalidate(box, has_moved_[instance] != 0);
    instance_scales_[instance] = scale;
}

void ShadowCache::publish(std::span<const pack::ResidentGroups::Change> groups)
{
    if (groups.empty())
        return;
    for (const auto& [group, resident] : groups)
    {
        const formats::GroupRecord& record = pack_.groups()[group];
        const uint32_t mesh = pack_.pages()[record.page].mesh;
        if (proxy_boxes_[mesh].empty())
            changed_errors_[mesh] = std::max(changed_errors_[mesh], record.error);
    }
    for (size_t instance = 0; instance < instance_bounds_.size(); ++instance)
        if (const float changed = changed_errors_[mesh_of_instance_[instance]]; changed != kUnchanged)
            invalidateFiner(instance, changed);
    std::fill(changed_errors_.begin(), changed_errors_.end(), kUnchanged);
}

/// Invalidate the maps that intersect the box, for moving or for resting instances.
void ShadowCache::invalidate(const Box3& box, bool moves)
{
    for (Layer& layer : layers_)
        if (bool& drawn = moves ? layer.moving_drawn : layer.drawn; drawn && intersects(layer.casters, box))
            drawn = false;
}

void ShadowCache::invalidateFiner(size_t instance, float error_object)
{
    const Box3& box = instance_bounds_[instance];
    const float error_world = error_object * instance_scales_[instance];
    for (Layer& layer : layers_)
        if (bool& drawn = has_moved_[instance] != 0 ? layer.moving_drawn : layer.drawn;
            drawn && mayExceed(layer.casters, box, error_world) && intersects(layer.casters, box))
            drawn = false;
}

bool ShadowCache::hasMoverIn(const shared::FrameView& casters) const
{
    return std::any_of(movers_.begin(), movers_.end(),
                       [&](uint32_t mover) { return intersects(casters, instance_bounds_[mover]); });
}

bool ShadowCache::hasSameContent(const Layer& layer, const Layer& other)
{
    return sameBits(layer.map, other.map) && sameBits(layer.light, other.light) &&
           sameBits(layer.casters, other.casters);
}

/// Return what a map of the plan shows. Its casters are those of the view, before cullingKey.
ShadowCache::Layer ShadowCache::makeLayer(const ShadowPlan& plan, uint32_t map,
                                          const shared::FrameView& view) const
{
    const uint32_t row = plan.row_of[map];
    Layer layer{.light = projectionKey(plan.block.lights[row]), .map = plan.block.maps[map]};
    layer.map.layer = 0;
    shared::FrameView seen = view;
    seen.eye = follows_eye_ ? shared::findEyeCell(view, plan.finest_m[row], plan.block.error_bias).eye
                            : layer.light.origin;
    layer.casters =
        shared::makeCasterView(seen, layer.light, layer.map, plan.block.error_bias, plan.range_m[row]);
    if (moving_layers_)
        layer.casters.flags |= shared::kCullMoving;
    return layer;
}

/// Give each map of the plan a layer of its own.
///
/// wanted  content of the maps
void ShadowCache::claimLayers(ShadowPlan& plan, std::span<const Layer> wanted)
{
    ++plans_;
    const auto claim = [&](size_t map, Layer& layer)
    {
        plan.block.maps[map].layer = static_cast<uint32_t>(&layer - layers_.data());
        layer.last_use = plans_;
    };
    constexpr uint32_t kNone = 0xFFFFFFFF;
    for (size_t map = 0; map < wanted.size(); ++map)
    {
        plan.block.maps[map].layer = kNone;
        const auto found =
            std::find_if(layers_.begin(), layers_.end(),
                         [&](const Layer& layer)
                         { return layer.last_use != plans_ && hasSameContent(layer, wanted[map]); });
        if (found != layers_.end())
            claim(map, *found);
    }
    for (size_t map = 0; map < wanted.size(); ++map)
        if (plan.block.maps[map].layer == kNone)
        {
            Layer& oldest =
                *std::min_element(layers_.begin(), layers_.end(),
                                  [](const Layer& a, const Layer& b) { return a.last_use < b.last_use; });
            HEARTH_ASSERT(oldest.last_use != plans_); // a plan has no more maps than there are layers
            oldest = wanted[map];
            claim(map, oldest);
        }
}

std::span<const ShadowCache::LayerUpdate> ShadowCache::plan(ShadowPlan& plan, const shared::FrameView& view)
{
    stale_.clear();
    wanted_.clear();
    std::array<shared::FrameView, shared::kMaxShadowMaps> casters;
    for (uint32_t i = 0; i < plan.map_count; ++i)
    {
        Layer& wanted = wanted_.emplace_back(makeLayer(plan, i, view));
        casters[i] = wanted.casters;
        wanted.casters = cullingKey(wanted.casters);
    }
    claimLayers(plan, wanted_);
    for (uint32_t i = 0; i < plan.map_count; ++i)
    {
        const uint32_t number = plan.block.maps[i].layer;
        Layer& layer = layers_[number];
        if (!layer.drawn)
        {
            layer.drawn = true;
            layer.moving_drawn = false;
            stale_.push_back({.map = i, .layer = number, .copy_from = {}, .casters = casters[i]});
        }
        planMoving(i, casters[i], layer, plan);
    }
    return stale_;
}

/// casters  view of the map's resting casters
void ShadowCache::planMoving(uint32_t map, const shared::FrameView& casters, Layer& layer, ShadowPlan& plan)
{
    if (!hasMoverIn(casters))
    {
        layer.moving_drawn = false;
        return;
    }
    const uint32_t resting = plan.block.maps[map].layer;
    const uint32_t moving = resting + static_cast<uint32_t>(layers_.size());
    plan.block.maps[map].layer = moving;
    if (layer.moving_drawn)
        return;
    layer.moving_drawn = true;
    stale_.push_back({.map = map, .layer = moving, .copy_from = resting, .casters = casters});
    stale_.back().casters.flags ^= shared::kCullMoving | shared::kCullStatic;
}

void ShadowCache::forget()
{
    for (Layer& layer : layers_)
        layer.drawn = false;
}

} // namespace hearth::gpu
