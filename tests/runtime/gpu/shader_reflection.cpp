// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/runtime/gpu/shader_reflection.h"

#include "formats/base/assert.h"

#include <algorithm>
#include <map>
#include <spirv_cross/spirv_cross_c.h>
#include <utility>

namespace hearth::test
{

namespace
{

void check(spvc_result result)
{
    HEARTH_ASSERT(result == SPVC_SUCCESS);
}

/// One module with its SPIRV-Cross objects.
class Reflector
{
public:
    explicit Reflector(std::span<const uint32_t> words)
    {
        check(spvc_context_create(&context_));
        spvc_parsed_ir ir = nullptr;
        check(spvc_context_parse_spirv(context_, words.data(), words.size(), &ir));
        check(spvc_context_create_compiler(context_, SPVC_BACKEND_NONE, ir, SPVC_CAPTURE_MODE_TAKE_OWNERSHIP,
                                           &compiler_));
    }
    ~Reflector() { spvc_context_destroy(context_); }
    Reflector(const Reflector&) = delete;
    Reflector& operator=(const Reflector&) = delete;

    ShaderReflection reflect()
    {
        spvc_set active = nullptr;
        check(spvc_compiler_get_active_interface_variables(compiler_, &active));
        spvc_resources resources = nullptr;
        check(spvc_compiler_create_shader_resources_for_active_variables(compiler_, &resources, active));
        constexpr std::pair<spvc_resource_type, VkDescriptorType> kTypes[] = {
            {SPVC_RESOURCE_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER},
            {SPVC_RESOURCE_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
            {SPVC_RESOURCE_TYPE_SAMPLED_IMAGE, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER},
            {SPVC_RESOURCE_TYPE_STORAGE_IMAGE, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE},
            {SPVC_RESOURCE_TYPE_SEPARATE_IMAGE, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE},
            {SPVC_RESOURCE_TYPE_SEPARATE_SAMPLERS, VK_DESCRIPTOR_TYPE_SAMPLER},
            {SPVC_RESOURCE_TYPE_SUBPASS_INPUT, VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT}};
        for (const auto& [kind, type] : kTypes)
            for (const spvc_reflected_resource& resource : list(resources, kind))
                addResource(resource, type);
        for (const spvc_reflected_resource& block : list(resources, SPVC_RESOURCE_TYPE_PUSH_CONSTANT))
            result_.push = describe(block.base_type_id);
        addConstants();
        if (spvc_compiler_get_execution_model(compiler_) == SpvExecutionModelGLCompute)
            for (unsigned i = 0; i < 3; ++i)
                result_.workgroup[i] = spvc_compiler_get_execution_mode_argument_by_index(
                    compiler_, SpvExecutionModeLocalSize, i);
        return std::move(result_);
    }

private:
    static std::span<const spvc_reflected_resource> list(spvc_resources resources, spvc_resource_type kind)
    {
        const spvc_reflected_resource* first = nullptr;
        size_t count = 0;
        check(spvc_resources_get_resource_list_for_type(resources, kind, &first, &count));
        return {first, count};
    }

    void addResource(const spvc_reflected_resource& resource, VkDescriptorType type)
    {
        const auto decoration = [&](SpvDecoration which)
        { return spvc_compiler_get_decoration(compiler_, resource.id, which); };
        result_.resources.push_back(
            {resource.name, decoration(SpvDecorationDescriptorSet), decoration(SpvDecorationBinding), type});
        if (type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER || type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER)
            result_.blocks.push_back(describe(resource.base_type_id));
    }

    void addConstants()
    {
        const spvc_specialization_constant* first = nullptr;
        size_t count = 0;
        check(spvc_compiler_get_specialization_constants(compiler_, &first, &count));
        for (const spvc_specialization_constant& constant : std::span(first, count))
            result_.constants.push_back(
                {spvc_compiler_get_name(compiler_, constant.id), constant.constant_id});
    }

    /// Describe a struct type, and add the structs inside to the result.
    ReflectedStruct describe(spvc_type_id id)
    {
        spvc_type type = spvc_compiler_get_type_handle(compiler_, id);
        ReflectedStruct described{spvc_compiler_get_name(compiler_, id), {}, 0};
        const unsigned count = spvc_type_get_num_member_types(type);
        for (unsigned i = 0; i < count; ++i)
        {
            spvc_type member = spvc_compiler_get_type_handle(compiler_, spvc_type_get_member_type(type, i));
            unsigned offset = 0, stride = 0;
            check(spvc_compiler_type_struct_member_offset(compiler_, type, i, &offset));
            if (spvc_type_get_num_array_dimensions(member) > 0)
                check(spvc_compiler_type_struct_member_array_stride(compiler_, type, i, &stride));
            described.members.push_back(
                {spvc_compiler_get_member_name(compiler_, id, i), offset, typeName(member), stride});
        }
        size_t size = 0;
        check(spvc_compiler_get_declared_struct_size(compiler_, type, &size));
        described.size = static_cast<uint32_t>(size);
        return described;
    }

    std::string typeName(spvc_type type)
    {
        const auto vector = [&](const std::string& scalar)
        {
            const unsigned size = spvc_type_get_vector_size(type);
            return size == 1 ? scalar : scalar + std::to_string(size);
        };
        switch (spvc_type_get_basetype(type))
        {
        case SPVC_BASETYPE_UINT32:
            return vector("uint");
        case SPVC_BASETYPE_INT32:
            return vector("int");
        case SPVC_BASETYPE_FP32:
            return vector("float");
        case SPVC_BASETYPE_STRUCT:
        {
            const ReflectedStruct inner = describe(spvc_type_get_base_type_id(type));
            const bool known = std::any_of(result_.structs.begin(), result_.structs.end(),
                                           [&](const ReflectedStruct& s) { return s.name == inner.name; });
            if (!known)
                result_.structs.push_back(inner);
            return inner.name;
        }
        default:
            return "another type";
        }
    }

    spvc_context context_ = nullptr;
    spvc_compiler compiler_ = nullptr;
    ShaderReflection result_;
};

/// Sum the sizes of a module's workgroup variables, of scalars of four bytes without padding.
uint32_t countSharedBytes(std::span<const uint32_t> words)
{
    std::map<uint32_t, uint32_t> type_bytes, constants, pointed;
    uint32_t sum = 0;
    constexpr size_t kHeaderWords = 5;
    for (size_t i = kHeaderWords; i < words.size(); i += words[i] >> 16)
    {
        const std::span<const uint32_t> op = words.subspan(i, words[i] >> 16);
        switch (op[0] & 0xFFFFu)
        {
        case SpvOpTypeBool:
        case SpvOpTypeInt:
        case SpvOpTypeFloat:
            type_bytes[op[1]] = 4;
            break;
        case SpvOpTypeVector:
        case SpvOpTypeMatrix:
            type_bytes[op[1]] = type_bytes[op[2]] * op[3];
            break;
        case SpvOpTypeArray:
            type_bytes[op[1]] = type_bytes[op[2]] * constants.at(op[3]);
            break;
        case SpvOpTypeStruct:
            for (const uint32_t member : op.subspan(2))
                type_bytes[op[1]] += type_bytes[member];
            break;
        case SpvOpConstant:
            constants[op[2]] = op[3];
            break;
        case SpvOpTypePointer:
            pointed[op[1]] = op[3];
            break;
        case SpvOpVariable:
            if (op[3] == SpvStorageClassWorkgroup)
                sum += type_bytes.at(pointed.at(op[1]));
            break;
        default:
            break;
        }
    }
    return sum;
}

} // namespace

ShaderReflection reflectShader(std::span<const uint32_t> words)
{
    ShaderReflection reflection = Reflector(words).reflect();
    reflection.shared_bytes = countSharedBytes(words);
    return reflection;
}

} // namespace hearth::test
