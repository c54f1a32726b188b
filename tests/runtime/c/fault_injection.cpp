// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/runtime/c/fault_injection.h"

#include "runtime/gpu/vulkan/device_table.h"

#include <cstdlib>
#include <new>
#include <optional>
#include <string_view>
#include <type_traits>

namespace hearth::test
{

namespace
{

struct State
{
    bool is_active = false;
    uint32_t caller_depth = 0;
    std::optional<Fault> fault; ///< that is due
    bool has_failed = false;
    HeldResources held;
};
thread_local State state;

bool isInLibrary()
{
    return state.is_active && state.caller_depth == 0;
}

/// Count a call at a place. Returns the result of the fault if it is due.
std::optional<VkResult> takeFault(FaultPlace place)
{
    if (!isInLibrary() || !state.fault || state.fault->place != place || state.fault->index-- > 0)
        return std::nullopt;
    const VkResult result = state.fault->result;
    state.fault.reset();
    state.has_failed = true;
    return result;
}

constexpr int64_t heldByCall(std::string_view name)
{
    if (name.starts_with("vkCreate") || name == "vkAllocateMemory")
        return 1;
    return name.starts_with("vkDestroy") || name == "vkFreeMemory" ? -1 : 0;
}

/// Function that stands for an entry point of Vulkan.
/// kHeld  objects that the call creates or destroys
template <typename Function, uint32_t kNumber, int64_t kHeld>
struct Interceptor;

template <typename Return, typename... Arguments, uint32_t kNumber, int64_t kHeld>
struct Interceptor<Return(VKAPI_PTR*)(Arguments...), kNumber, kHeld>
{
    static inline Return(VKAPI_PTR* real)(Arguments...) = nullptr;

    static VKAPI_ATTR Return VKAPI_CALL call(Arguments... arguments)
    {
        if constexpr (std::is_same_v<Return, VkResult>)
        {
            if (const std::optional<VkResult> fault = takeFault(FaultPlace::vulkan))
                return *fault;
            const bool counts = isInLibrary();
            const CallerScope scope;
            const VkResult result = real(arguments...);
            state.held.vulkan_objects += counts && result == VK_SUCCESS ? kHeld : 0;
            return result;
        }
        else
        {
            state.held.vulkan_objects += isInLibrary() ? kHeld : 0;
            const CallerScope scope;
            return real(arguments...);
        }
    }
};

enum FunctionNumber : uint32_t
{
#define HEARTH_NUMBER(name) kNumber_##name,
    HEARTH_INSTANCE_FUNCTIONS(HEARTH_NUMBER) HEARTH_DEVICE_FUNCTIONS(HEARTH_NUMBER)
#undef HEARTH_NUMBER
};

#define HEARTH_INTERCEPT(name)                                                                               \
    if (wanted == #name)                                                                                     \
    {                                                                                                        \
        using Stand = Interceptor<PFN_##name, kNumber_##name, heldByCall(#name)>;                            \
        Stand::real = reinterpret_cast<PFN_##name>(function);                                                \
        return reinterpret_cast<PFN_vkVoidFunction>(Stand::call);                                            \
    }

PFN_vkGetInstanceProcAddr real_instance_proc_addr = nullptr;
PFN_vkGetDeviceProcAddr real_device_proc_addr = nullptr;

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getDeviceProcAddr(VkDevice device, const char* name)
{
    const CallerScope scope;
    const PFN_vkVoidFunction function = real_device_proc_addr(device, name);
    const std::string_view wanted = name;
    HEARTH_DEVICE_FUNCTIONS(HEARTH_INTERCEPT)
    return function;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getInstanceProcAddr(VkInstance instance, const char* name)
{
    const CallerScope scope;
    const PFN_vkVoidFunction function = real_instance_proc_addr(instance, name);
    const std::string_view wanted = name;
    if (wanted == "vkGetDeviceProcAddr")
    {
        real_device_proc_addr = reinterpret_cast<PFN_vkGetDeviceProcAddr>(function);
        return reinterpret_cast<PFN_vkVoidFunction>(getDeviceProcAddr);
    }
    HEARTH_INSTANCE_FUNCTIONS(HEARTH_INTERCEPT)
    return function;
}

VkResult allocatePiece(void* user, const hearth_memory_request* request, hearth_memory_allocation* piece)
{
    if (const std::optional<VkResult> fault = takeFault(FaultPlace::hook))
        return *fault;
    const CallerScope scope;
    const auto& hooks = *static_cast<const hearth_memory_hooks*>(user);
    return hooks.allocate(hooks.user, request, piece);
}

void freePiece(void* user, const hearth_memory_allocation* piece)
{
    const CallerScope scope;
    const auto& hooks = *static_cast<const hearth_memory_hooks*>(user);
    hooks.free(hooks.user, piece);
}

/// Return null without memory.
void* allocateBlock(size_t size, size_t alignment)
{
    const size_t bytes = (size / alignment + 1) * alignment;
    void* block = alignment <= __STDCPP_DEFAULT_NEW_ALIGNMENT__ ? std::malloc(bytes)
                                                                : std::aligned_alloc(alignment, bytes);
    state.held.heap_blocks += block != nullptr && isInLibrary() ? 1 : 0;
    return block;
}

void* allocateOrThrow(size_t size, size_t alignment)
{
    void* const block = takeFault(FaultPlace::heap) ? nullptr : allocateBlock(size, alignment);
    if (block == nullptr)
        throw std::bad_alloc();
    return block;
}

void freeBlock(void* block)
{
    state.held.heap_blocks -= block != nullptr && isInLibrary() ? 1 : 0;
    std::free(block);
}

} // namespace

FaultScope::FaultScope()
{
    state.is_active = true;
    state.has_failed = false;
    state.fault.reset();
}

FaultScope::FaultScope(const Fault& fault) : FaultScope()
{
    state.fault = fault;
}

FaultScope::~FaultScope()
{
    state.is_active = false;
    state.fault.reset();
}

bool FaultScope::hasFailed() const
{
    return state.has_failed;
}

CallerScope::CallerScope()
{
    ++state.caller_depth;
}

CallerScope::~CallerScope()
{
    --state.caller_depth;
}

HeldResources heldResources()
{
    return state.held;
}

PFN_vkGetInstanceProcAddr interceptVulkan(PFN_vkGetInstanceProcAddr real)
{
    real_instance_proc_addr = real;
    return getInstanceProcAddr;
}

hearth_memory_hooks faultingHooks(hearth_memory_hooks& real)
{
    return {&real, allocatePiece, freePiece};
}

} // namespace hearth::test

// Replaces the operators of the program; the other forms call these.
void* operator new(size_t size)
{
    return hearth::test::allocateOrThrow(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__);
}

// Never fails: callers, std::stable_sort among them, do without the memory.
void* operator new(size_t size, const std::nothrow_t&) noexcept
{
    return hearth::test::allocateBlock(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__);
}

void* operator new(size_t size, std::align_val_t alignment)
{
    return hearth::test::allocateOrThrow(size, static_cast<size_t>(alignment));
}

void operator delete(void* block) noexcept
{
    hearth::test::freeBlock(block);
}

void operator delete(void* block, size_t) noexcept
{
    hearth::test::freeBlock(block);
}

void operator delete(void* block, std::align_val_t) noexcept
{
    hearth::test::freeBlock(block);
}

void operator delete(void* block, size_t, std::align_val_t) noexcept
{
    hearth::test::freeBlock(block);
}
