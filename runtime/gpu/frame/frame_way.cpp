// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/frame/frame_way.h"

#include <string_view>

namespace hearth::gpu
{

namespace
{

constexpr uint32_t kVendorApple = 0x106B;
constexpr uint32_t kVendorArm = 0x13B5;
constexpr uint32_t kVendorQualcomm = 0x5143;

struct DeviceFact
{
    uint32_t vendor;
    std::string_view name; ///< the device's name begins with it, and no digit follows
    FrameWay way;
};

constexpr DeviceFact kFacts[] = {
    // Crash at subpassLoad in shaders of several descriptor sets, and not in those of one:
    // https://github.com/godotengine/godot/issues/112530, https://github.com/godotengine/godot/pull/114785
    {kVendorArm, "Mali-G52", FrameWay::one_set},
    {kVendorArm, "Mali-G72", FrameWay::one_set},
    // Do not merge subpasses, so nothing is saved by them, and the G76 crashes as the two above:
    // https://community.arm.com/support-forums/f/graphics-gaming-and-vr-forum/54380
    {kVendorArm, "Mali-G76", FrameWay::separate},
    {kVendorArm, "Mali-G77", FrameWay::separate},
    // Input attachments break in shaders with specialization constants, even unused ones, and all that shade
    // have some. Mesa's driver names its devices "Turnip Adreno":
    // https://github.com/godotengine/godot/pull/113467
    {kVendorQualcomm, "Adreno", FrameWay::separate},
    // MoltenVK: each subpass is a render pass of Metal, and transient attachments lose their content between
    // them: https://github.com/KhronosGroup/MoltenVK/issues/2454,
    // https://github.com/KhronosGroup/MoltenVK/issues/490
    {kVendorApple, "Apple", FrameWay::separate},
};

bool isDigit(char c)
{
    return c >= '0' && c <= '9';
}

bool applies(const DeviceFact& fact, const DeviceIdentity& device)
{
    const std::string_view name = device.name;
    return fact.vendor == device.vendor && name.starts_with(fact.name) &&
           (name.size() == fact.name.size() || !isDigit(name[fact.name.size()]));
}

} // namespace

FrameWay chooseFrameWay(const DeviceIdentity& device)
{
    for (const DeviceFact& fact : kFacts)
        if (applies(fact, device))
            return fact.way;
    return FrameWay::merged;
}

} // namespace hearth::gpu
