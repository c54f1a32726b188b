// Compares shaders with the C++ side of their interface: layouts, push constants, specialization
// constants and structs.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/runtime/gpu/pipeline_recorder.h"
#include "tests/runtime/gpu/shader_reflection.h"
#include "tests/runtime/gpu/shared_structs.h"

#include <map>
#include <string>

namespace hearth::test
{

struct InterfaceShader
{
    std::string name;
    std::vector<uint32_t> words; ///< as pipelines get them
    ShaderReflection reflection; ///< with names
};

/// All that crosses, of both sides.
struct GpuInterface
{
    std::vector<InterfaceShader> shaders;
    std::vector<RecordedPipeline> pipelines;
    std::vector<SharedStruct> structs;
    std::map<std::string, uint32_t> constant_ids; ///< by the name of the specialization constant
};

/// Return a line for each difference; none if both sides agree, every shader is in a pipeline, and every
/// binding of a layout is used by a shader.
std::vector<std::string> findDifferences(const GpuInterface& gpu_interface);

} // namespace hearth::test
