// Reads the JSON of a glTF file with strict types: every property is checked where it is read.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/container.h"
#include "pipelines/import/gltf/document/json_document.h"
#include "pipelines/import/part/part_builder.h"

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hearth::import
{

/// Upper end of the range of a number that has none.
inline constexpr float kUnbounded = std::numeric_limits<float>::max();

/// First error of a document. Readers of properties continue after it with harmless values and test once at
/// the end, which keeps them as plain as the tables of the specification.
class GltfProblems
{
public:
    GltfProblems(std::string file, PartBuilder& part) : file_(std::move(file)), part_(&part) {}

    void fail(Issue issue, const Json& at, std::string detail);
    void warn(Issue issue, const Json& at, std::string detail);
    void warn(Issue issue, std::string pointer, std::string detail);

    bool ok() const { return !error_.has_value(); }
    Status status() const { return ok() ? success() : Status(*error_); }
    const std::string& file() const { return file_; }

private:
    std::string file_;
    PartBuilder* part_;
    std::optional<Error> error_;
};

enum class Need
{
    optional,
    required,
};

/// Closed range of integers that a property may have.
struct IntegerRange
{
    uint64_t min = 0;
    uint64_t max = UINT64_MAX;
};

struct Choice
{
    std::string_view name;
    uint32_t value;
};

/// JSON object of the document. Absent optional properties read as their default; invalid ones are recorded
/// as errors and read as their default too.
class GltfObject
{
public:
    /// Wrap a JSON value. errors: gltf_structure if `json` is not an object.
    GltfObject(const Json& json, GltfProblems& problems);

    const Json& json() const { return json_; }
    GltfProblems& problems() const { return *problems_; }

    bool has(std::string_view name) const { return find(name).has_value(); }

    /// Return an integer below `size` ("24.0" is one, "0.5", "\"24\"", null and -1 are not), or kInvalidIndex
    /// if it is absent.
    /// errors: gltf_structure, gltf_reference.
    uint32_t index(std::string_view name, size_t size, Need need = Need::optional) const;

    /// Return the elements of an array of such integers.
    std::vector<uint32_t> indices(std::string_view name, size_t size, Need need = Need::optional) const;

    /// Return an integer in the range. errors: gltf_structure, gltf_value (outside the range).
    uint64_t integer(std::string_view name, IntegerRange range, std::optional<uint64_t> fallback) const;

    /// Return a number in the range of floats. Without a fallback it must be present.
    float number(std::string_view name, std::optional<float> fallback) const;

    /// Return a number in [min, max]; an outside one is clamped with a warning, as exporters are careless
    /// with factors.
    float factor(std::string_view name, float fallback, float min, float max) const;

    template <size_t N>
    std::array<float, N> numbers(std::string_view name, const std::array<float, N>& fallback) const
    {
        std::array<float, N> values = fallback;
        readNumbers(name, values);
        return values;
    }

    /// Return an array of numbers of any length; empty if it is absent.
    std::vector<float> numberList(std::string_view name) const;

    /// Return the elements of an array of arrays: of indices below `size`, or of numbers.
    std::vector<std::vector<uint32_t>> indexLists(std::string_view name, size_t size, Need need) const;
    std::vector<std::vector<float>> numberLists(std::string_view name, Need need) const;

    bool boolean(std::string_view name, bool fallback) const;
    std::string text(std::string_view name, Need need = Need::optional) const;

    /// Return the value of a string among `choices`. errors: gltf_value for other strings.
    uint32_t choice(std::string_view name, std::span<const Choice> choices,
                    std::optional<uint32_t> fallback) const;

    std::optional<GltfObject> object(std::string_view name, Need need = Need::optional) const;

    /// Return the elements of an array, each an object.
    std::vector<GltfObject> objects(std::string_view name, Need need = Need::optional) const;

    /// Return object `name` of this object's "extensions".
    std::optional<GltfObject> extension(std::string_view name) const;

private:
    std::optional<Json> find(std::string_view name) const { return json_.find(name); }
    std::optional<Json> findRequired(std::string_view name, Need need) const;
    std::optional<Json> findArray(std::string_view name, Need need) const;
    template <typename Read>
    auto readLists(std::string_view name, Need need, const Read& read) const;
    std::optional<double> readInteger(const Json& value) const;
    uint32_t readIndex(const Json& value, size_t size) const;
    float readNumber(const Json& value) const;
    void readNumbers(std::string_view name, std::span<float> values) const;
    void wrongType(const Json& value, std::string_view wanted) const;

    Json json_;
    GltfProblems* problems_;
};

} // namespace hearth::import
