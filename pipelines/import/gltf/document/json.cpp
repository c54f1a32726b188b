// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/document/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hearth::import
{

namespace
{

// upper bound of doubles below which every integer is exact
constexpr double kMaxExactInteger = 9007199254740992.0;

// Extensions that Hearth reads and the Khronos glTF validator does not check.
constexpr std::string_view kUncheckedExtensions[] = {
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "KHR_draco_mesh_compression",
    "KHR_texture_basisu",
    "MSFT_lod",
    "MSFT_texture_dds",
};

/// True if the validator does not look at a place of a document: custom properties, and some extensions.
bool isUnchecked(std::string_view pointer)
{
    constexpr std::string_view kExtensions = "/extensions/";
    const size_t at = pointer.find(kExtensions);
    const std::string_view name =
        at == pointer.npos ? std::string_view() : pointer.substr(at + kExtensions.size());
    return pointer.find("/extras/") != pointer.npos || pointer.ends_with("/extras") ||
           std::any_of(std::begin(kUncheckedExtensions), std::end(kUncheckedExtensions),
                       [&](std::string_view extension) { return name.starts_with(extension); });
}

} // namespace

void GltfProblems::fail(Issue issue, const Json& at, std::string detail)
{
    if (error_)
        return;
    // these issues send the user to the validator, which would find nothing here
    const bool names_validator =
        issue == Issue::gltf_structure || issue == Issue::gltf_value || issue == Issue::gltf_reference;
    std::string pointer = at.pointer();
    if (names_validator && isUnchecked(pointer))
        issue = Issue::gltf_extension_value;
    error_ = Error{issue, file_, std::move(pointer), std::move(detail)};
}

void GltfProblems::warn(Issue issue, const Json& at, std::string detail)
{
    warn(issue, at.pointer(), std::move(detail));
}

void GltfProblems::warn(Issue issue, std::string pointer, std::string detail)
{
    part_->warn(issue, std::move(pointer), std::move(detail));
}

GltfObject::GltfObject(const Json& json, GltfProblems& problems) : json_(json), problems_(&problems)
{
    if (!json.isObject())
        wrongType(json, "an object");
}

void GltfObject::wrongType(const Json& value, std::string_view wanted) const
{
    problems_->fail(Issue::gltf_structure, value,
                    fmt::format("must be {}, but is {}", wanted, jsonTypeName(value.type())));
}

std::optional<Json> GltfObject::findRequired(std::string_view name, Need need) const
{
    const std::optional<Json> value = find(name);
    if (!value && need == Need::required)
        problems_->fail(Issue::gltf_structure, json_, fmt::format("property \"{}\" is missing", name));
    return value;
}

std::optional<Json> GltfObject::findArray(std::string_view name, Need need) const
{
    const std::optional<Json> value = findRequired(name, need);
    if (!value || value->isArray())
        return value;
    wrongType(*value, "an array");
    return std::nullopt;
}

std::optional<double> GltfObject::readInteger(const Json& value) const
{
    if (!value.isNumber())
    {
        wrongType(value, "an integer");
        return std::nullopt;
    }
    const double number = value.number();
    if (number != std::floor(number))
    {
        problems_->fail(Issue::gltf_structure, value, fmt::format("must be an integer, but is {}", number));
        return std::nullopt;
    }
    return number;
}

uint32_t GltfObject::readIndex(const Json& value, size_t size) const
{
    const std::optional<double> number = readInteger(value);
    if (!number)
        return kInvalidIndex;
    if (*number < 0 || *number >= static_cast<double>(size))
    {
        problems_->fail(Issue::gltf_reference, value, fmt::format("index {} of {}", *number, size));
        return kInvalidIndex;
    }
    return static_cast<uint32_t>(*number);
}

uint32_t GltfObject::index(std::string_view name, size_t size, Need need) const
{
    const std::optional<Json> value = findRequired(name, need);
    return value ? readIndex(*value, size) : kInvalidIndex;
}

std::vector<uint32_t> GltfObject::indices(std::string_view name, size_t size, Need need) const
{
    std::vector<uint32_t> values;
    if (const std::optional<Json> array = findArray(name, need))
    {
        values.reserve(array->size());
        for (size_t i = 0; i < array->size(); ++i)
            values.push_back(readIndex((*array)[i], size));
    }
    return values;
}

uint64_t GltfObject::integer(std::string_view name, IntegerRange range,
                             std::optional<uint64_t> fallback) const
{
    const uint64_t harmless = fallback.value_or(range.min);
    const std::optional<Json> value = findRequired(name, fallback ? Need::optional : Need::required);
    const std::optional<double> number = value ? readInteger(*value) : std::nullopt;
    if (!number)
        return harmless;
    const double max = std::min(static_cast<double>(range.max), kMaxExactInteger);
    if (*number < static_cast<double>(range.min) || *number > max)
    {
        problems_->fail(Issue::gltf_value, *value,
                        fmt::format("must be in {} to {}, but is {}", range.min, max, *number));
        return harmless;
    }
    return static_cast<uint64_t>(*number);
}

float GltfObject::readNumber(const Json& value) const
{
    if (!value.isNumber())
    {
        wrongType(value, "a number");
        return 0;
    }
    const double number = value.number();
    constexpr double kMaxNumber = std::numeric_limits<float>::max();
    if (!(std::abs(number) <= kMaxNumber))
    {
        problems_->fail(Issue::number_too_large, value,
                        fmt::format("{} is too large: 32-bit numbers go up to {:g}", number, kMaxNumber));
        return 0;
    }
    return static_cast<float>(number);
}

float GltfObject::number(std::string_view name, std::optional<float> fallback) const
{
    const std::optional<Json> value = findRequired(name, fallback ? Need::optional : Need::required);
    return value ? readNumber(*value) : fallback.value_or(0.0f);
}

float GltfObject::factor(std::string_view name, float fallback, float min, float max) const
{
    const std::optional<Json> value = find(name);
    if (!value)
        return fallback;
    const float read = readNumber(*value);
    const float inside = std::clamp(read, min, max);
    if (inside != read)
        problems_->warn(Issue::repaired, *value,
                        fmt::format("{} is outside {} to {}: {} is used", read, min, max, inside));
    return inside;
}

void GltfObject::readNumbers(std::string_view name, std::span<float> values) const
{
    const std::optional<Json> array = findArray(name, Need::optional);
    if (!array)
        return;
    if (array->size() != values.size())
    {
        problems_->fail(Issue::gltf_structure, *array,
                        fmt::format("must have {} numbers, but has {}", values.size(), array->size()));
        return;
    }
    for (size_t i = 0; i < values.size(); ++i)
        values[i] = readNumber((*array)[i]);
}

std::vector<float> GltfObject::numberList(std::string_view name) const
{
    std::vector<float> values;
    if (const std::optional<Json> array = findArray(name, Need::optional))
        for (size_t i = 0; i < array->size(); ++i)
            values.push_back(readNumber((*array)[i]));
    return values;
}

/// Return read(value) of each element of the arrays in an array.
template <typename Read>
auto GltfObject::readLists(std::string_view name, Need need, const Read& read) const
{
    std::vector<std::vector<std::invoke_result_t<Read, Json>>> lists;
    const std::optional<Json> array = findArray(name, need);
    for (size_t i = 0; array && i < array->size(); ++i)
    {
        const Json list = (*array)[i];
        if (!list.isArray())
            wrongType(list, "an array");
        lists.emplace_back();
        for (size_t k = 0; list.isArray() && k < list.size(); ++k)
            lists.back().push_back(read(list[k]));
    }
    return lists;
}

std::vector<std::vector<uint32_t>> GltfObject::indexLists(std::string_view name, size_t size, Need need) const
{
    return readLists(name, need, [&](const Json& value) { return readIndex(value, size); });
}

std::vector<std::vector<float>> GltfObject::numberLists(std::string_view name, Need need) const
{
    return readLists(name, need, [&](const Json& value) { return readNumber(value); });
}

bool GltfObject::boolean(std::string_view name, bool fallback) const
{
    const std::optional<Json> value = find(name);
    if (!value)
        return fallback;
    if (value->type() != JsonType::boolean)
    {
        wrongType(*value, "a boolean");
        return fallback;
    }
    return value->boolean();
}

std::string GltfObject::text(std::string_view name, Need need) const
{
    const std::optional<Json> value = findRequired(name, need);
    if (!value)
        return {};
    if (!value->isString())
    {
        wrongType(*value, "a string");
        return {};
    }
    return std::string(value->string());
}

uint32_t GltfObject::choice(std::string_view name, std::span<const Choice> choices,
                            std::optional<uint32_t> fallback) const
{
    const uint32_t harmless = fallback.value_or(choices.front().value);
    const std::optional<Json> value = findRequired(name, fallback ? Need::optional : Need::required);
    if (!value)
        return harmless;
    if (!value->isString())
    {
        wrongType(*value, "a string");
        return harmless;
    }
    for (const Choice& choice : choices)
        if (choice.name == value->string())
            return choice.value;
    problems_->fail(Issue::gltf_value, *value, fmt::format("\"{}\" is not known here", value->string()));
    return harmless;
}

std::optional<GltfObject> GltfObject::object(std::string_view name, Need need) const
{
    const std::optional<Json> value = findRequired(name, need);
    if (!value)
        return std::nullopt;
    return GltfObject(*value, *problems_);
}

std::vector<GltfObject> GltfObject::objects(std::string_view name, Need need) const
{
    std::vector<GltfObject> values;
    if (const std::optional<Json> array = findArray(name, need))
    {
        values.reserve(array->size());
        for (size_t i = 0; i < array->size(); ++i)
            values.emplace_back((*array)[i], *problems_);
    }
    return values;
}

std::optional<GltfObject> GltfObject::extension(std::string_view name) const
{
    const std::optional<GltfObject> extensions = object("extensions");
    return extensions ? extensions->object(name) : std::nullopt;
}

} // namespace hearth::import
