// Lights of a scene: their slots, and the buffer in which shaders find them, their surroundings, and the
// lists of the frame (formats/gpu_shared/shading.h, Lighting).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/receivers.h"
#include "formats/scene/scene_lighting.h"
#include "runtime/frame/light_lists.h"
#include "runtime/gpu/lights/light_method.h"
#include "runtime/gpu/vulkan/mirrored_table.h"

#include <span>
#include <vector>

namespace hearth::gpu
{

/// Processor that lists the lights of cells (LightAreas::cells). The lists are the same, word for word.
enum class LightLister : uint8_t
{
    gpu,
    cpu,
};

/// Parts of the buffer of lights, in bytes from its begin.
struct LightBufferLayout
{
    uint32_t capacity = 0;    ///< slots of lights
    uint32_t index_words = 0; ///< room for indices
    VkDeviceSize sky_image = 0;
    VkDeviceSize local_probes = 0;
    VkDeviceSize surroundings = 0;
    VkDeviceSize receivers = 0; ///< shared::ReceiverRow of each instance; none in scenes without receivers
    VkDeviceSize lists = 0;     ///< the parts before it are the table, those after it are the frame's
    VkDeviceSize cells = 0;     ///< words of all lists, whatever has them
    VkDeviceSize indices = 0;
    VkDeviceSize in_view = 0; ///< shared::CellLight of the ranged lights of the frame; passes of the device
    VkDeviceSize end = 0;

    /// lighting           its sky and its local probes have rows
    /// surroundings_rows  of 16 bytes, as receiver_rows
    static LightBufferLayout make(uint32_t capacity, const shared::SceneLighting& lighting,
                                  uint64_t surroundings_rows, uint64_t receiver_rows = 0);
    VkDeviceSize light(uint32_t slot) const
    {
        return sizeof(shared::Lighting) + VkDeviceSize{slot} * sizeof(shared::Light);
    }
};

class SceneLights
{
public:
    SceneLights(const LightBufferLayout& layout, shared::SceneLighting lighting);

    const LightBufferLayout& layout() const { return layout_; }

    /// Slots of lights up to the last that was ever used. An empty slot has a light that is off.
    std::span<const shared::Light> lights() const { return lighting_.lights; }
    float exposure() const { return lighting_.exposure; }
    /// Lights of the pack as loaded, in the first slots.
    std::span<const shared::Light> loaded() const { return loaded_; }

    /// Set the content of the table, with the rows of the sky's image, of local probes, of surroundings and
    /// of receivers behind the lights.
    /// transfer_rows  of `surroundings`, before those of instances; all of them if the scene has none
    void fill(MirroredTable& table, std::span<const std::byte> surroundings, uint64_t transfer_rows,
              bool has_surroundings, std::span<const std::byte> receivers = {});

    /// Describe receivers to shaders, before `fill`: the rows of instances, and the atlas if there is one.
    void setAtlas(const formats::ReceiverAtlasRecord& atlas);

    /// Replace the light of a slot below the capacity. It keeps the slot's shadow row and its weight.
    /// steady_luminance  of its intensity without flicker
    void set(MirroredTable& table, uint32_t slot, const shared::Light& light, float steady_luminance);

    /// Replace the colours of the gradient, in scenes whose sky is no image. The next frame has them.
    void setSky(const shared::Sky& sky);
    bool hasSkyImage() const { return lighting_.sky.image != nullptr; }
    /// The sky as loaded.
    const shared::Sky& loadedSky() const { return loaded_sky_; }

    /// Local probes as loaded.
    const shared::LocalProbes& localProbes() const { return lighting_.local_probes; }

    /// Weigh the light of a local probe by channels, relative to its own.
    void weighProbe(MirroredTable& table, size_t probe, Float3 weight);

    /// Set the weight of a slot, by which its light is multiplied; 1 until then.
    void setWeight(MirroredTable& table, uint32_t slot, Float3 weight);

    /// Say which receivers have the light of a slot in use: shared::kLightBaked, shared::kLightOnFaces.
    void setBaked(MirroredTable& table, uint32_t slot, uint32_t bits);

    /// Luminance of a slot's intensity without flicker, under its weight.
    float steadyLuminance(uint32_t slot) const;

    /// Set the shadow row of a slot in use.
    void setShadowRow(MirroredTable& table, uint32_t slot, uint32_t row);

    /// Number of lights with a range that are on, in view or not.
    uint32_t rangedCount() const;

    /// True if a frame lists its lights on the device: without ranged lights the lists are those of the frame
    /// alone, which the CPU has at once.
    bool listsOnDevice(LightLister lister, LightAreas areas) const
    {
        return (lister == LightLister::gpu || areas != LightAreas::cells) && rangedCount() > 0;
    }

    /// Write the grid of the frame's view to the copy of a frame, and the lists unless listsOnDevice.
    void beginFrame(const MirroredTable& table, uint32_t copy, const shared::FrameView& view,
                    LightLister lister, LightAreas areas);

    /// Grid of the last frame, tiles of its image, and the number of its lists.
    const shared::LightGrid& grid() const { return head_.grid; }
    const shared::LightCascade& tiles() const { return head_.tiles; }
    uint32_t listCount() const { return head_.list_count; }

private:
    /// Facts about a slot beside its light as it shines.
    struct Slot
    {
        Float3 intensity; ///< with weight 1
        float steady_luminance;
        Float3 weight{1, 1, 1};
        uint32_t baked = 0; ///< bits of shared::Light::reflector_axis
    };
    void reserveSlot(uint32_t slot);
    /// Weigh the intensity of a slot, and write its light.
    void writeLight(MirroredTable& table, uint32_t slot);
    /// Light of a slot as shaders see it.
    shared::Light sharedLight(size_t slot) const;
    shared::LightListView listView(const Buffer& buffer) const;

    LightBufferLayout layout_;
    shared::SceneLighting lighting_;
    std::vector<shared::Light> loaded_;
    shared::Sky loaded_sky_;
    std::vector<Slot> slots_; ///< [lights().size()]
    shared::Lighting head_{};
    shared::LightLists lists_;
};

} // namespace hearth::gpu
