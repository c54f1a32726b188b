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
        float number = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(number))
            return std::nullopt;
        numbers.push_back(number);
    }
    return numbers;
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

Result<MaterialBinding> bindMaterial(const formats::PackView& pack, uint32_t material,
                                     std::span<const std::string_view> functions)
{
    MaterialBinding binding;
    if (functions.empty())
        return binding;
    const std::string_view extras = pack.findExtras(formats::ExtrasOwner::material, material);
    std::string_view name = pack::findMember(extras, kFunctionExtra);
    if (name.empty())
        return binding;
    const std::string object = "material \"" + std::string(pack.text(pack.materials()[material].name)) + "\"";
    if (name.size() >= 2 && name.front() == '"')
        name = name.substr(1, name.size() - 2);
    const auto found = std::find(functions.begin(), functions.end(), name);
    if (found == functions.end())
        return Error{Issue::usage, pack.name(), object,
                     "of " + std::string(pack.name()) + " has the extra " + std::string(kFunctionExtra) +
                         " \"" + std::string(name) + "\"; the game has the material functions " +
                         listNames(functions)};
    binding.function = static_cast<uint32_t>(std::distance(functions.begin(), found)) + 1;
    const std::string_view parameters = pack::findMember(extras, kParametersExtra);
    if (parameters.empty())
        return binding;
    const std::optional<std::vector<float>> numbers = readNumbers(trim(parameters));
    if (!numbers || numbers->size() > kNumbers)
        return Error{Issue::usage, pack.name(), object,
                     "of " + std::string(pack.name()) + " has an extra " + std::string(kParametersExtra) +
                         " that is no array of at most 16 numbers"};
    for (size_t i = 0; i < numbers->size(); ++i)
    {
        Float4& row = binding.parameters[i / 4];
        (i % 4 == 0 ? row.x : i % 4 == 1 ? row.y : i % 4 == 2 ? row.z : row.w) = (*numbers)[i];
    }
    return binding;
}

} // namespace hearth::gpu
