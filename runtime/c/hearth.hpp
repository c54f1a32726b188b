// C++20 wrapper of hearth.h: owning handles, and messages as strings. Nothing else; the rules of hearth.h
// hold.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "hearth.h"

#include <cassert>
#include <string>
#include <string_view>
#include <utility>

namespace hearth
{

/// Owning handle of hearth.h. Everything made from it must be destroyed before it, so declare it first.
template <typename T, hearth_result (*kDestroy)(T*)>
class Handle
{
public:
    Handle() = default;
    explicit Handle(T* handle) : handle_(handle) {}
    Handle(Handle&& other) noexcept : handle_(other.release()) {}
    Handle& operator=(Handle&& other) noexcept
    {
        if (this != &other)
            reset(other.release());
        return *this;
    }
    ~Handle() { reset(); }

    T* get() const { return handle_; }
    explicit operator bool() const { return handle_ != nullptr; }

    /// Release ownership to the caller, who destroys the handle.
    T* release() { return std::exchange(handle_, nullptr); }

    void reset(T* handle = nullptr)
    {
        [[maybe_unused]] const hearth_result destroyed = kDestroy(std::exchange(handle_, handle));
        assert(destroyed == HEARTH_OK); // HEARTH_ERROR_IN_USE: the handle leaks
    }

private:
    T* handle_ = nullptr;
};

/// Call `function(message, message_size)`, and store the message of a failure in `message` if it is not null.
template <typename Function>
hearth_result callWithMessage(std::string* message, const Function& function)
{
    char text[512] = "";
    const hearth_result result = function(text, sizeof(text));
    if (result != HEARTH_OK && message != nullptr)
        *message = text;
    return result;
}

/// Pack file. The functions `open` and `create` leave their target as it was if they fail.
class Pack : public Handle<hearth_pack, hearth_pack_close>
{
public:
    using Handle::Handle;

    [[nodiscard]] static hearth_result open(const std::string& path, Pack& pack,
                                            std::string* message = nullptr)
    {
        hearth_pack* handle = nullptr;
        const hearth_result result =
            callWithMessage(message, [&](char* text, size_t size)
                            { return hearth_pack_open(path.c_str(), &handle, text, size); });
        if (result == HEARTH_OK)
            pack.reset(handle);
        return result;
    }

    [[nodiscard]] static hearth_result openMemory(const void* bytes, size_t size, const std::string& name,
                                                  Pack& pack, std::string* message = nullptr)
    {
        hearth_pack* handle = nullptr;
        const hearth_result result = callWithMessage(
            message, [&](char* text, size_t text_size)
            { return hearth_pack_open_memory(bytes, size, name.c_str(), &handle, text, text_size); });
        if (result == HEARTH_OK)
            pack.reset(handle);
        return result;
    }

    [[nodiscard]] hearth_result check(std::string* message = nullptr) const
    {
        return callWithMessage(message, [&](char* text, size_t text_size)
                               { return hearth_pack_check(get(), text, text_size); });
    }

    [[nodiscard]] hearth_result readPage(uint32_t page, void* destination, size_t size,
                                         std::string* message = nullptr) const
    {
        return callWithMessage(
            message, [&](char* text, size_t text_size)
            { return hearth_pack_read_page(get(), page, destination, size, text, text_size); });
    }

    [[nodiscard]] hearth_result getCount(uint32_t table, uint32_t& count,
                                         std::string* message = nullptr) const
    {
        return callWithMessage(message, [&](char* text, size_t size)
                               { return hearth_pack_get_count(get(), table, &count, text, size); });
    }

    /// The name is valid while the pack is open.
    [[nodiscard]] hearth_result getName(uint32_t table, uint32_t index, std::string_view& name,
                                        std::string* message = nullptr) const
    {
        hearth_name read{};
        const hearth_result result =
            callWithMessage(message, [&](char* text, size_t size)
                            { return hearth_pack_get_name(get(), table, index, &read, text, size); });
        if (result == HEARTH_OK)
            name = {read.text, read.length};
        return result;
    }

    /// The JSON text is valid while the pack is open; empty if the object has no extras.
    /// owner  HEARTH_EXTRAS_*
    [[nodiscard]] hearth_result getExtras(uint32_t owner, uint32_t index, std::string_view& json,
                                          std::string* message = nullptr) const
    {
        hearth_extras read{};
        const hearth_result result =
            callWithMessage(message, [&](char* text, size_t size)
                            { return hearth_pack_get_extras(get(), owner, index, &read, text, size); });
        if (result == HEARTH_OK)
            json = read.json == nullptr ? std::string_view() : std::string_view(read.json, read.length);
        return result;
    }

    /// Find the first record with a name whose index is `first` or more. Pass the index that was found, plus
    /// 1, to go on.
    [[nodiscard]] hearth_result findRecord(uint32_t table, const std::string& name, uint32_t& index,
                                           uint32_t first = 0, std::string* message = nullptr) const
    {
        return callWithMessage(
            message, [&](char* text, size_t size)
            { return hearth_pack_find_record(get(), table, name.c_str(), first, &index, text, size); });
    }

    /// Find the first object, from `first` on, whose extras have a member.
    /// owner  HEARTH_EXTRAS_*
    /// value  JSON text of the member; valid while the pack is open
    [[nodiscard]] hearth_result findExtra(uint32_t owner, const std::string& name, uint32_t& index,
                                          std::string_view& value, uint32_t first = 0,
                                          std::string* message = nullptr) const
    {
        hearth_extras read{};
        const hearth_result result = callWithMessage(
            message, [&](char* text, size_t size)
            { return hearth_pack_find_extra(get(), owner, name.c_str(), first, &index, &read, text, size); });
        if (result == HEARTH_OK)
            value = {read.json, read.length};
        return result;
    }

    [[nodiscard]] hearth_result getNode(uint32_t index, hearth_pack_node& node,
                                        std::string* message = nullptr) const
    {
        return callWithMessage(message, [&](char* text, size_t size)
                               { return hearth_pack_get_node(get(), index, &node, text, size); });
    }

    [[nodiscard]] hearth_result getMesh(uint32_t index, hearth_pack_mesh& mesh,
                                        std::string* message = nullptr) const
    {
        return callWithMessage(message, [&](char* text, size_t size)
                               { return hearth_pack_get_mesh(get(), index, &mesh, text, size); });
    }

    [[nodiscard]] hearth_result getSkin(uint32_t index, hearth_pack_skin& skin,
                                        std::string* message = nullptr) const
    {
        return callWithMessage(message, [&](char* text, size_t size)
                               { return hearth_pack_get_skin(get(), index, &skin, text, size); });
    }

    /// index  of HEARTH_TABLE_JOINTS
    [[nodiscard]] hearth_result getJoint(uint32_t index, hearth_pack_joint& joint,
                                         std::string* message = nullptr) const
    {
        return callWithMessage(message, [&](char* text, size_t size)
                               { return hearth_pack_get_joint(get(), index, &joint, text, size); });
    }

    [[nodiscard]] hearth_result getLight(uint32_t index, hearth_light_change& light,
                                         std::string* message = nullptr) const
    {
        return callWithMessage(message, [&](char* text, size_t size)
                               { return hearth_pack_get_light(get(), index, &light, nullptr, text, size); });
    }

    [[nodiscard]] hearth_result getInstance(uint32_t index, hearth_pack_instance& instance,
                                            std::string* message = nullptr) const
    {
        return callWithMessage(message, [&](char* text, size_t size)
                               { return hearth_pack_get_instance(get(), index, &instance, text, size); });
    }

    [[nodiscard]] hearth_result getCamera(uint32_t index, hearth_pack_camera& camera,
                                          std::string* message = nullptr) const
    {
        return callWithMessage(message, [&](char* text, size_t size)
                               { return hearth_pack_get_camera(get(), index, &camera, text, size); });
    }

    /// The arrays of the proxy are valid while the pack is open.
    [[nodiscard]] hearth_result getProxy(uint32_t index, hearth_proxy& proxy,
                                         std::string* message = nullptr) const
    {
        return callWithMessage(message, [&](char* text, size_t size)
                               { return hearth_pack_get_proxy(get(), index, &proxy, text, size); });
    }

    /// Bounds of instances over all times of a clip.
    [[nodiscard]] hearth_result getClipBounds(uint32_t animation, uint32_t first, uint32_t count,
                                              hearth_box& box, std::string* message = nullptr) const
    {
        return callWithMessage(
            message, [&](char* text, size_t size)
            { return hearth_pack_get_clip_bounds(get(), animation, first, count, &box, text, size); });
    }

    const char* lastError() const { return hearth_pack_last_error(get()); }
};

/// Plays the clips of a pack, which outlives it.
class Player : public Handle<hearth_player, hearth_player_destroy>
{
public:
    using Handle::Handle;

    [[nodiscard]] static hearth_result create(const Pack& pack, Player& player,
                                              std::string* message = nullptr)
    {
        hearth_player* handle = nullptr;
        const hearth_result result =
            callWithMessage(message, [&](char* text, size_t size)
                            { return hearth_player_create(pack.get(), &handle, text, size); });
        if (result == HEARTH_OK)
            player.reset(handle);
        return result;
    }

    /// from    none: at rest
    /// to      a second clip, or none
    /// weight  of the second clip
    [[nodiscard]] hearth_result goTo(const hearth_clip* from, const hearth_clip* to = nullptr,
                                     double weight = 0, std::string* message = nullptr)
    {
        return callWithMessage(message, [&](char* text, size_t size)
                               { return hearth_player_go_to(get(), from, to, weight, text, size); });
    }

    [[nodiscard]] hearth_result getInfo(hearth_player_info& info) const
    {
        return hearth_player_get_info(get(), &info);
    }

    /// Compute the lights of the pose, with their flicker at a time.
    [[nodiscard]] hearth_result getLights(double flicker_seconds, hearth_player_lights& lights,
                                          std::string* message = nullptr)
    {
        return callWithMessage(
            message, [&](char* text, size_t size)
            { return hearth_player_get_lights(get(), flicker_seconds, &lights, text, size); });
    }
};

/// Bounds, rays and picked pixels of a pack, which outlives them.
class Queries : public Handle<hearth_queries, hearth_queries_destroy>
{
public:
    using Handle::Handle;

    [[nodiscard]] static hearth_result create(const Pack& pack, const hearth_queries_options& options,
                                              Queries& queries, std::string* message = nullptr)
    {
        hearth_queries* handle = nullptr;
        const hearth_result result =
            callWithMessage(message, [&](char* text, size_t size)
                            { return hearth_queries_create(pack.get(), &options, &handle, text, size); });
        if (result == HEARTH_OK)
            queries.reset(handle);
        return result;
    }

    /// Move and pose instances by the arrays of a frame.
    [[nodiscard]] hearth_result place(const hearth_move* moves, uint32_t move_count, const hearth_pose* poses,
                                      uint32_t pose_count, std::string* message = nullptr)
    {
        return callWithMessage(
            message, [&](char* text, size_t size)
            { return hearth_queries_place(get(), moves, move_count, poses, pose_count, text, size); });
    }

    [[nodiscard]] hearth_result getBounds(uint32_t first, uint32_t count, hearth_box& box,
                                          std::string* message = nullptr) const
    {
        return callWithMessage(message, [&](char* text, size_t size)
                               { return hearth_queries_get_bounds(get(), first, count, &box, text, size); });
    }

    /// cast  or null
    [[nodiscard]] hearth_result castRays(const hearth_ray* rays, uint32_t ray_count, const hearth_cast* cast,
                                         hearth_hit* hits, std::string* message = nullptr)
    {
        return callWithMessage(
            message, [&](char* text, size_t size)
            { return hearth_queries_cast_rays(get(), rays, ray_count, cast, hits, text, size); });
    }

    /// Find the point of the pick of pixel (x, y) in a frame whose targets have this size.
    [[nodiscard]] hearth_result findPick(const hearth_frame& frame, uint32_t width, uint32_t height,
                                         uint32_t x, uint32_t y, const hearth_pick& pick, hearth_hit& hit,
                                         std::string* message = nullptr)
    {
        return callWithMessage(message,
                               [&](char* text, size_t size) {
                                   return hearth_queries_find_pick(get(), &frame, width, height, x, y, &pick,
                                                                   &hit, text, size);
                               });
    }

    /// Cast one ray.
    [[nodiscard]] hearth_result castRay(const hearth_ray& ray, hearth_hit& hit,
                                        const hearth_cast* cast = nullptr, std::string* message = nullptr)
    {
        return castRays(&ray, 1, cast, &hit, message);
    }
};

class Renderer : public Handle<hearth_renderer, hearth_renderer_destroy>
{
public:
    using Handle::Handle;

    [[nodiscard]] static hearth_result create(const hearth_renderer_description& description,
                                              Renderer& renderer, std::string* message = nullptr)
    {
        hearth_renderer* handle = nullptr;
        const hearth_result result =
            callWithMessage(message, [&](char* text, size_t size)
                            { return hearth_renderer_create(&description, &handle, text, size); });
        if (result == HEARTH_OK)
            renderer.reset(handle);
        return result;
    }

    const char* lastError() const { return hearth_last_error(get()); }
};

class Targets : public Handle<hearth_targets, hearth_targets_destroy>
{
public:
    using Handle::Handle;

    [[nodiscard]] static hearth_result create(const Renderer& renderer,
                                              const hearth_targets_description& description, Targets& targets)
    {
        hearth_targets* handle = nullptr;
        const hearth_result result = hearth_targets_create(renderer.get(), &description, &handle);
        if (result == HEARTH_OK)
            targets.reset(handle);
        return result;
    }

    [[nodiscard]] hearth_result getInfo(hearth_targets_info& info) const
    {
        return hearth_targets_get_info(get(), &info);
    }

    [[nodiscard]] hearth_result getPartInfo(uint32_t part, hearth_part_info& info) const
    {
        return hearth_targets_get_part_info(get(), part, &info);
    }
};

class Scene : public Handle<hearth_scene, hearth_scene_destroy>
{
public:
    using Handle::Handle;

    [[nodiscard]] static hearth_result upload(const Renderer& renderer, const Pack& pack,
                                              VkCommandBuffer commands, const hearth_scene_options& options,
                                              Scene& scene)
    {
        hearth_scene* handle = nullptr;
        const hearth_result result =
            hearth_scene_upload(renderer.get(), pack.get(), commands, &options, &handle);
        if (result == HEARTH_OK)
            scene.reset(handle);
        return result;
    }

    [[nodiscard]] hearth_result releaseStaging() { return hearth_scene_release_staging(get()); }
    [[nodiscard]] hearth_result getInfo(hearth_scene_info& info) const
    {
        return hearth_scene_get_info(get(), &info);
    }
    [[nodiscard]] hearth_result beginFrame(uint64_t serial, uint64_t completed_serial)
    {
        return hearth_scene_begin_frame(get(), serial, completed_serial);
    }
    [[nodiscard]] hearth_result getStreamCounters(hearth_stream_counters& counters) const
    {
        return hearth_scene_get_stream_counters(get(), &counters);
    }
    [[nodiscard]] hearth_result prepareLights(uint32_t method) const
    {
        return hearth_scene_prepare_lights(get(), method);
    }
    [[nodiscard]] hearth_result getShadowCounters(hearth_shadow_counters& counters) const
    {
        return hearth_scene_get_shadow_counters(get(), &counters);
    }
    [[nodiscard]] hearth_result retryFailed() { return hearth_scene_retry_failed(get()); }
    [[nodiscard]] hearth_result record(Targets& targets, VkCommandBuffer commands, const hearth_frame& frame)
    {
        return hearth_record_frame(get(), targets.get(), commands, &frame);
    }
    [[nodiscard]] hearth_result recordCull(Targets& targets, VkCommandBuffer commands,
                                           const hearth_frame& frame)
    {
        return hearth_record_cull(get(), targets.get(), commands, &frame);
    }
    [[nodiscard]] hearth_result recordVisibility(Targets& targets, VkCommandBuffer commands,
                                                 const hearth_frame& frame)
    {
        return hearth_record_visibility(get(), targets.get(), commands, &frame);
    }
    [[nodiscard]] hearth_result recordMaterials(Targets& targets, VkCommandBuffer commands,
                                                const hearth_frame& frame)
    {
        return hearth_record_materials(get(), targets.get(), commands, &frame);
    }
    /// The passes of a frame as JSON.
    [[nodiscard]] hearth_result describePasses(const Targets& targets, const hearth_frame& frame,
                                               std::string& json) const
    {
        size_t needed = 0;
        hearth_result result = hearth_describe_passes(get(), targets.get(), &frame, nullptr, 0, &needed);
        if (result != HEARTH_OK)
            return result;
        json.resize(needed);
        result = hearth_describe_passes(get(), targets.get(), &frame, json.data(), json.size(), &needed);
        json.resize(needed - 1); // without the zero
        return result;
    }
    [[nodiscard]] hearth_result recordMissing(Targets& targets, VkCommandBuffer commands)
    {
        return hearth_record_missing(get(), targets.get(), commands);
    }
    [[nodiscard]] hearth_result recordPrefetch(Targets& targets, VkCommandBuffer commands,
                                               const hearth_frame& frame)
    {
        return hearth_record_prefetch(get(), targets.get(), commands, &frame);
    }
    [[nodiscard]] hearth_result recordMotion(Targets& targets, VkCommandBuffer commands)
    {
        return hearth_record_motion(get(), targets.get(), commands);
    }
    [[nodiscard]] hearth_result recordAntiAliasing(Targets& targets, VkCommandBuffer commands,
                                                   bool reset = false)
    {
        return hearth_record_anti_aliasing(get(), targets.get(), commands, reset ? 1 : 0);
    }
    [[nodiscard]] hearth_result preparePicks() { return hearth_scene_prepare_picks(get()); }
    [[nodiscard]] hearth_result recordPicks(Targets& targets, VkCommandBuffer commands,
                                            const hearth_pixels& pixels, VkBuffer destination,
                                            VkDeviceSize offset)
    {
        return hearth_record_picks(get(), targets.get(), commands, &pixels, destination, offset);
    }
    [[nodiscard]] hearth_result recordCounters(VkCommandBuffer commands, VkBuffer destination,
                                               VkDeviceSize offset)
    {
        return hearth_record_counters(get(), commands, destination, offset);
    }
};

} // namespace hearth
