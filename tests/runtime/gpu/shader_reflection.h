// Reflects compiled shaders: resources, blocks, push constants and specialization constants.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/vulkan/device_table.h"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hearth::test
{

struct ReflectedResource
{
    std::string name;
    uint32_t set;
    uint32_t binding;
    VkDescriptorType type;
};

struct ReflectedMember
{
    std::string name;
    uint32_t offset;
    std::string type;      ///< "uint", "int", "float", "float2" to "float4", or the name of a struct
    uint32_t array_stride; ///< 0: no array
};

struct ReflectedStruct
{
    std::string name;
    std::vector<ReflectedMember> members;
    uint32_t size; ///< without padding behind the last member; 0 if that is an array without a size
};

struct ReflectedConstant
{
    std::string name;
    uint32_t id;
};

struct ShaderReflection
{
    std::vector<ReflectedResource> resources; ///< that the shader uses
    std::optional<ReflectedStruct> push;      ///< block of push constants
    std::vector<ReflectedStruct> blocks;      ///< uniform blocks and storage buffers
    std::vector<ReflectedStruct> structs;     ///< structs inside blocks, each once
    std::vector<ReflectedConstant> constants;
    std::array<uint32_t, 3> workgroup{}; ///< threads; zeros: no compute shader
    uint32_t shared_bytes = 0;           ///< memory of a workgroup
};

/// Reflect a module. Names are empty if it has been stripped.
ShaderReflection reflectShader(std::span<const uint32_t> words);

} // namespace hearth::test
