// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/runtime/gpu/interface_check.h"

#include <algorithm>
#include <set>

namespace hearth::test
{

namespace
{

std::string typeName(VkDescriptorType type)
{
    switch (type)
    {
    case VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER:
        return "uniform buffer";
    case VK_DESCRIPTOR_TYPE_STORAGE_BUFFER:
        return "storage buffer";
    case VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER:
        return "texture";
    case VK_DESCRIPTOR_TYPE_STORAGE_IMAGE:
        return "storage image";
    case VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT:
        return "input attachment";
    default:
        return "descriptor of type " + std::to_string(type);
    }
}

/// Binding, type and stages of each descriptor: layouts with equal keys are interchangeable.
using SetKey = std::vector<std::array<uint32_t, 3>>;

SetKey makeKey(const RecordedSet& set)
{
    SetKey key;
    for (const VkDescriptorSetLayoutBinding& binding : set)
        key.push_back({binding.binding, static_cast<uint32_t>(binding.descriptorType), binding.stageFlags});
    std::sort(key.begin(), key.end());
    return key;
}

class Comparison
{
public:
    explicit Comparison(const GpuInterface& sides) : sides_(sides) {}

    std::vector<std::string> run()
    {
        for (const InterfaceShader& shader : sides_.shaders)
            compareStructs(shader);
        for (const RecordedPipeline& pipeline : sides_.pipelines)
            for (const RecordedStage& stage : pipeline.stages)
                compareStage(pipeline, stage);
        findUnusedBindings();
        for (const InterfaceShader& shader : sides_.shaders)
            if (!seen_shaders_.contains(shader.name))
                report(shader.name + ": no pipeline has it");
        for (const SharedStruct& known : sides_.structs)
            if (!seen_structs_.contains(known.name))
                report(known.name + ": no shader has it in a block");
        return std::move(lines_);
    }

private:
    /// Add a line once: pipelines that differ in constants only have the same shaders.
    void report(const std::string& line)
    {
        if (std::find(lines_.begin(), lines_.end(), line) == lines_.end())
            lines_.push_back(line);
    }

    const SharedStruct* findStruct(const std::string& name) const
    {
        const auto found = std::find_if(sides_.structs.begin(), sides_.structs.end(),
                                        [&](const SharedStruct& s) { return s.name == name; });
        return found == sides_.structs.end() ? nullptr : &*found;
    }

    void compareStructs(const InterfaceShader& shader)
    {
        for (const ReflectedStruct& in_shader : shader.reflection.structs)
        {
            const std::string who = shader.name + ": struct " + in_shader.name;
            seen_structs_.insert(in_shader.name);
            const SharedStruct* in_cpp = findStruct(in_shader.name);
            if (in_cpp == nullptr)
                report(who + " is not in the list of shared structs");
            else
                compareStruct(who, in_shader, *in_cpp);
        }
        for (const ReflectedStruct& block : shader.reflection.blocks)
            for (const ReflectedMember& member : block.members)
                if (const SharedStruct* element = findStruct(member.type);
                    element != nullptr && member.array_stride != 0 && member.array_stride != element->size)
                    report(shader.name + ": an array of " + member.type + " in " + block.name + " has " +
                           std::to_string(member.array_stride) + " bytes for each, in C++ " +
                           std::to_string(element->size));
    }

    void compareStruct(const std::string& who, const ReflectedStruct& in_shader, const SharedStruct& in_cpp)
    {
        if (in_shader.members.size() != in_cpp.members.size())
        {
            report(who + " has " + std::to_string(in_shader.members.size()) + " members, in C++ " +
                   std::to_string(in_cpp.members.size()));
            return;
        }
        for (size_t i = 0; i < in_cpp.members.size(); ++i)
        {
            const ReflectedMember& a = in_shader.members[i];
            const SharedMember& b = in_cpp.members[i];
            if (a.name != b.name || a.offset != b.offset || a.type != b.type ||
                a.array_stride != b.element_size)
                report(who + " has " + describe(a.type, a.name, a.array_stride, a.offset) + ", C++ " +
                       describe(b.type, b.name, b.element_size, b.offset));
        }
        if (in_shader.size > in_cpp.size)
            report(who + " has " + std::to_string(in_shader.size) + " bytes, in C++ " +
                   std::to_string(in_cpp.size));
    }

    static std::string describe(const std::string& type, const std::string& name, size_t stride,
                                size_t offset)
    {
        return type + " " + name + (stride > 0 ? "[] of " + std::to_string(stride) + " bytes" : "") +
               " at byte " + std::to_string(offset);
    }

    void compareStage(const RecordedPipeline& pipeline, const RecordedStage& stage)
    {
        const auto flags = static_cast<VkShaderStageFlags>(stage.stage);
        bool listed = false;
        for (const InterfaceShader& shader : sides_.shaders)
            if (std::equal(shader.words.begin(), shader.words.end(), stage.words.begin(), stage.words.end()))
            {
                listed = true;
                seen_shaders_.insert(shader.name);
                for (const ReflectedResource& resource : shader.reflection.resources)
                    compareResource(shader.name, resource, pipeline, flags);
                comparePush(shader, pipeline, flags);
                compareConstants(shader, stage);
            }
        if (!listed)
            report("a pipeline has a shader that is not in the list");
        for (const RecordedSet& set : pipeline.sets)
            used_bindings_[makeKey(set)]; // also those that no resource uses
    }

    void compareResource(const std::string& shader, const ReflectedResource& resource,
                         const RecordedPipeline& pipeline, VkShaderStageFlags stage)
    {
        const std::string who = shader + ": " + resource.name + " (set " + std::to_string(resource.set) +
                                ", binding " + std::to_string(resource.binding) + ", " +
                                typeName(resource.type) + ")";
        if (resource.set >= pipeline.sets.size())
            return report(who + ": the layout has no such set");
        const RecordedSet& set = pipeline.sets[resource.set];
        const auto found = std::find_if(set.begin(), set.end(),
                                        [&](const VkDescriptorSetLayoutBinding& binding)
                                        { return binding.binding == resource.binding; });
        if (found == set.end())
            return report(who + ": the layout has no such binding");
        used_bindings_[makeKey(set)].insert(resource.binding);
        if (found->descriptorType != resource.type)
            report(who + ": the layout has a " + typeName(found->descriptorType));
        if ((found->stageFlags & stage) == 0)
            report(who + ": the layout has it for other stages");
    }

    void comparePush(const InterfaceShader& shader, const RecordedPipeline& pipeline,
                     VkShaderStageFlags stage)
    {
        if (!shader.reflection.push)
            return;
        const ReflectedStruct& block = *shader.reflection.push;
        const SharedStruct* in_cpp = block.members.size() == 1 && block.members[0].offset == 0
                                         ? findStruct(block.members[0].type)
                                         : nullptr;
        if (in_cpp == nullptr)
            return report(shader.name + ": its push constants are no shared struct");
        const auto range =
            std::find_if(pipeline.push.begin(), pipeline.push.end(),
                         [&](const VkPushConstantRange& r) { return (r.stageFlags & stage) != 0; });
        if (range == pipeline.push.end())
            report(shader.name + ": the layout has no push constants for its stage");
        else if (range->offset != 0 || range->size != in_cpp->size)
            report(shader.name + ": " + in_cpp->name + " has " + std::to_string(in_cpp->size) +
                   " bytes, the layout " + std::to_string(range->size) + " from byte " +
                   std::to_string(range->offset));
    }

    void compareConstants(const InterfaceShader& shader, const RecordedStage& stage)
    {
        for (const ReflectedConstant& constant : shader.reflection.constants)
        {
            const std::string who =
                shader.name + ": constant " + constant.name + " (id " + std::to_string(constant.id) + ")";
            const auto known = sides_.constant_ids.find(constant.name);
            if (known == sides_.constant_ids.end())
                report(who + " is not in the list of specialization constants");
            else if (known->second != constant.id)
                report(who + " has id " + std::to_string(known->second) + " in C++");
            const auto given = stage.constants.find(constant.id);
            if (given == stage.constants.end())
                report(who + ": a pipeline gives it no value");
            else if (given->second != sizeof(uint32_t))
                report(who + ": a pipeline gives it " + std::to_string(given->second) + " bytes");
        }
    }

    void findUnusedBindings()
    {
        for (const auto& [set, used] : used_bindings_)
            for (const auto& [binding, type, stages] : set)
                if (!used.contains(binding))
                    report("no shader uses binding " + std::to_string(binding) + " (" +
                           typeName(static_cast<VkDescriptorType>(type)) + ") of a set layout of " +
                           std::to_string(set.size()) + " bindings: " + listUsers(set));
    }

    /// Name the shaders whose pipelines have a set layout.
    std::string listUsers(const SetKey& set) const
    {
        std::string names;
        for (const InterfaceShader& shader : sides_.shaders)
            for (const RecordedPipeline& pipeline : sides_.pipelines)
                if (pipeline.stages.back().words == shader.words &&
                    std::any_of(pipeline.sets.begin(), pipeline.sets.end(),
                                [&](const RecordedSet& s) { return makeKey(s) == set; }))
                {
                    names += (names.empty() ? "" : ", ") + shader.name;
                    break;
                }
        return names;
    }

    const GpuInterface& sides_;
    std::vector<std::string> lines_;
    std::set<std::string> seen_shaders_;
    std::set<std::string> seen_structs_;
    std::map<SetKey, std::set<uint32_t>> used_bindings_; ///< by layout
};

} // namespace

std::vector<std::string> findDifferences(const GpuInterface& gpu_interface)
{
    return Comparison(gpu_interface).run();
}

} // namespace hearth::test
