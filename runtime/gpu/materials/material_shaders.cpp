// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/materials/material_shaders.h"

#include "runtime/pack/queries/extras_member.h"
#include "runtime/shaders/sources_version.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>

namespace hearth::gpu
{

namespace
{

constexpr std::string_view kFunctionExtra = "hearth_material";
constexpr std::string_view kParametersExtra = "hearth_parameters";
constexpr std::string_view kMotionExtra = "hearth_motion";
constexpr std::string_view kBoundExtra = "hearth_motion_bound";
constexpr uint32_t kSpirvMagic = 0x07230203; ///< first word of every module
constexpr size_t kNumbers = size_t{4} * shared::kMaterialParameters;
static_assert(kNumbers == 16, "the message says so");

std::string_view trim(std::string_view text)
{
    constexpr std::string_view kSpace = " \t\r\n";
    const size_t first = text.find_first_not_of(kSpace);
    return first == text.npos ? std::string_view()
                              : text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

std::string listNames(std::span<const std::string_view> names)
{
    std::string text;
    for (const std::string_view name : names)
        text += (text.empty() ? "" : ", ") + std::string(name);
    return text;
}

std::optional<float> readNumber(std::string_view json)
{
    const std::string_view text = trim(json);
    float number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(number))
        return std::nullopt;
    return number;
}

/// Read a JSON array of finite numbers.
std::optional<std::vector<float>> readNumbers(std::string_view json)
{
    if (json.size() < 2 || json.front() != '[' || json.back() != ']')
        return std::nullopt;
    json = json.substr(1, json.size() - 2);
    std::vector<float> numbers;
    if (trim(json).empty())
        return numbers;
    for (bool is_last = false; !is_last && numbers.size() <= kNumbers;)
    {
        const size_t comma = json.find(',');
        is_last = comma == json.npos;
        const std::string_view text = trim(json.substr(0, comma));
        json = is_last ? std::string_view() : json.substr(comma + 1);
        const std::optional<float> number = readNumber(text);
        if (!number)
            return std::nullopt;
        numbers.push_back(*number);
    }
    return numbers;
}

/// Material whose extras are read.
struct NamedMaterial
{
    std::string_view extras;
    std::string_view pack;
    std::string name;

    Error error(const std::string& detail) const
    {
        return {Issue::usage, std::string(pack), "material \"" + name + "\"",
                "of " + std::string(pack) + " " + detail};
    }
};

/// Return the number of the name that an extra has, 0 if there is no such extra.
Result<uint32_t> findNumber(const NamedMaterial& material, std::string_view extra,
                            std::span<const std::string_view> names)
{
    std::string_view name = pack::findMember(material.extras, extra);
    if (name.empty())
        return 0;
    if (name.size() >= 2 && name.front() == '"')
        name = name.substr(1, name.size() - 2);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
        return material.error("has the extra " + std::string(extra) + " \"" + std::string(name) +
                              "\"; the game has " + (names.empty() ? "none" : listNames(names)));
    return static_cast<uint32_t>(std::distance(names.begin(), found)) + 1;
}

Status readParameters(const NamedMaterial& material, MaterialBinding& binding)
{
    const std::string_view parameters = pack::findMember(material.extras, kParametersExtra);
    if (parameters.empty())
        return success();
    const std::optional<std::vector<float>> numbers = readNumbers(trim(parameters));
    if (!numbers || numbers->size() > kNumbers)
        return material.error("has an extra " + std::string(kParametersExtra) +
                              " that is no array of at most 16 numbers");
    for (size_t i = 0; i < numbers->size(); ++i)
    {
        Float4& row = binding.parameters[i / 4];
        (i % 4 == 0 ? row.x : i % 4 == 1 ? row.y : i % 4 == 2 ? row.z : row.w) = (*numbers)[i];
    }
    return success();
}

Result<MaterialBinding> bindMaterial(const NamedMaterial& material, const MaterialShaders& shaders)
{
    MaterialBinding binding;
    HEARTH_ASSIGN_OR_RETURN(binding.function, findNumber(material, kFunctionExtra, shaders.functions));
    HEARTH_ASSIGN_OR_RETURN(binding.motion, findNumber(material, kMotionExtra, shaders.motions));
    if (binding.function == 0 && binding.motion == 0)
        return binding;
    HEARTH_TRY(readParameters(material, binding));
    if (binding.motion == 0)
        return binding;
    const std::optional<float> bound = readNumber(pack::findMember(material.extras, kBoundExtra));
    if (!bound || !(*bound > 0))
        return material.error("has the extra " + std::string(kMotionExtra) + " and no extra " +
                              std::string(kBoundExtra) + " above 0: the metres that a vertex moves at most");
    binding.motion_bound = *bound;
    return binding;
}

} // namespace

Status checkMaterialShaders(const MaterialShaders& shaders)
{
    if (shaders.version != shaders::kSourcesVersion)
        return Error{
            Issue::usage, "", "",
            "the game's material functions were compiled with other shaders of Hearth than those of the "
            "library: build the game against the Hearth that it links"};
    for (const MaterialModule& module : shaders.modules)
        if (module.words.empty() || module.words[0] != kSpirvMagic)
            return Error{Issue::usage, "", "",
                         "the module " + std::string(module.name) +
                             " of the material functions is no SPIR-V"};
    return success();
}

Result<std::span<const uint32_t>> findModule(const MaterialShaders& shaders, std::string_view name)
{
    for (const MaterialModule& module : shaders.modules)
        if (module.name == name)
            return module.words;
    return Error{Issue::usage, "", "",
                 "the game's material functions are not compiled for the shader " + std::string(name) +
                     ": name the light method in hearth_add_material_shaders()"};
}

Result<std::vector<MaterialBinding>> bindMaterials(const formats::PackView& pack,
                                                   const MaterialShaders* shaders)
{
    std::vector<MaterialBinding> bindings(pack.materials().size());
    if (shaders == nullptr)
        return bindings;
    for (uint32_t i = 0; i < bindings.size(); ++i)
    {
        const NamedMaterial material{pack.findExtras(formats::ExtrasOwner::material, i), pack.name(),
                                     std::string(pack.text(pack.materials()[i].name))};
        HEARTH_ASSIGN_OR_RETURN(bindings[i], bindMaterial(material, *shaders));
    }
    return bindings;
}

} // namespace hearth::gpu
