// Lets single calls to the heap, to Vulkan and to memory hooks fail, and counts what the library holds. For
// one thread at a time.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/c/hearth.h"

#include <cstdint>
#include <ostream>

namespace hearth::test
{

/// Place of a fault.
enum class FaultPlace : uint8_t
{
    heap,   ///< operator new throws std::bad_alloc
    vulkan, ///< an entry point that returns a VkResult
    hook,   ///< hearth_memory_hooks::allocate, of faultingHooks
};

struct Fault
{
    FaultPlace place = FaultPlace::heap;
    uint64_t index = 0; ///< calls at this place that succeed before it
    VkResult result = VK_ERROR_OUT_OF_HOST_MEMORY;
};

/// Runs calls of the library with at most one fault. While none lives, nothing fails and nothing is counted.
class FaultScope
{
public:
    /// Let nothing fail.
    FaultScope();
    explicit FaultScope(const Fault& fault);
    ~FaultScope();
    FaultScope(const FaultScope&) = delete;
    FaultScope& operator=(const FaultScope&) = delete;

    bool hasFailed() const; ///< the fault has happened
};

/// Code of the caller within a FaultScope: the driver, or a callback. Nothing in it fails or is counted.
class CallerScope
{
public:
    CallerScope();
    ~CallerScope();
    CallerScope(const CallerScope&) = delete;
    CallerScope& operator=(const CallerScope&) = delete;
};

/// Return what the library has created within all scopes so far and not destroyed.
struct HeldResources
{
    int64_t heap_blocks = 0;
    int64_t vulkan_objects = 0; ///< and allocations of device memory
    friend bool operator==(const HeldResources&, const HeldResources&) = default;
    friend std::ostream& operator<<(std::ostream& out, const HeldResources& held)
    {
        return out << held.heap_blocks << " blocks, " << held.vulkan_objects << " objects";
    }
};
HeldResources heldResources();

/// Return an entry point whose functions call those of `real`, of one loader at a time.
PFN_vkGetInstanceProcAddr interceptVulkan(PFN_vkGetInstanceProcAddr real);

/// Return hooks that call `real`, which they refer to, unless a fault is due.
hearth_memory_hooks faultingHooks(hearth_memory_hooks& real);

} // namespace hearth::test
