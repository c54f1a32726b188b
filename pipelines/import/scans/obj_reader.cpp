// Reads Wavefront OBJ: the polygonal part of the "Object Files (.obj)" appendix of the Advanced Visualizer
// manual, with the vertex colours that scanners write after the coordinates. Groups and objects become one
// mesh.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/scans/scan_polygons.h"
#include "pipelines/import/scans/text_cursor.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>

namespace hearth::import
{

namespace
{

using namespace std::string_view_literals;
/// Statements of the manual that draw nothing here; other unsupported statements are named in a warning.
constexpr std::array kIgnoredKeywords = {"g"sv,          "o"sv,         "s"sv,      "mg"sv,
                                         "bevel"sv,      "c_interp"sv,  "lod"sv,    "d_interp"sv,
                                         "shadow_obj"sv, "trace_obj"sv, "maplib"sv, "usemap"sv};

/// Number of occurrences of an unsupported statement, and the line of the first.
struct Occurrences
{
    size_t count = 0;
    size_t first_line = 0;
};

/// Largest index of one kind that was used before its element was defined, if it ever is defined.
struct ForwardReference
{
    uint64_t index = 0;
    size_t line = 0;
};

enum Kind : size_t
{
    kPosition,
    kUv,
    kNormal,
};
constexpr std::array kKindNames = {"vertex"sv, "texture coordinate"sv, "normal"sv};

class ObjReader
{
public:
    explicit ObjReader(const ScanSource& source) : source_(source), text_(source.text()) {}

    Result<ScanPolygons> read()
    {
        for (; !text_.atEnd(); text_.nextLine())
        {
            text_.skipBlanks();
            if (text_.atLineEnd() || text_.startsWith('#'))
                continue;
            HEARTH_TRY(readStatement());
        }
        HEARTH_TRY(checkReferences());
        finishNotes();
        file_.vertex_count = file_.positions.size();
        return std::move(file_);
    }

private:
    Error error(Issue issue, std::string detail) const
    {
        return {issue, source_.path, text_.where(), std::move(detail)};
    }
    Error syntax(std::string detail) const { return error(Issue::mesh_syntax, std::move(detail)); }

    Status readStatement()
    {
        const std::string_view keyword = text_.word();
        if (keyword == "v")
            return readPosition();
        if (keyword == "vn")
            return readNormal();
        if (keyword == "vt")
            return readUv();
        if (keyword == "f" || keyword == "fo")
            return readFace();
        if (keyword == "usemtl")
            useMaterial(text_.restOfLine());
        else if (keyword == "mtllib")
            file_.material_libraries.emplace_back(text_.restOfLine());
        else if (std::find(kIgnoredKeywords.begin(), kIgnoredKeywords.end(), keyword) ==
                 kIgnoredKeywords.end())
            return countUnsupported(keyword);
        return success();
    }

    /// Read numbers up to the end of the line or a comment, at most as many as `values` holds.
    template <size_t N>
    Result<size_t> readNumbers(std::array<double, N>& values)
    {
        size_t count = 0;
        for (text_.skipBlanks(); !text_.atLineEnd() && !text_.startsWith('#'); text_.skipBlanks())
        {
            if (joinLine())
                continue;
            const auto value = readNumber();
            if (!value || count == N)
                return syntax(value ? "more than " + std::to_string(N) + " numbers"
                                    : fmt::format("'{}' is not a number", truncateWord(text_.word())));
            values[count++] = *value;
        }
        return count;
    }

    /// Read a number; the exponent's sign before its letter ("3.1+e2") is repaired.
    std::optional<double> readNumber()
    {
        if (const auto value = text_.number())
            return value;
        TextCursor ahead = text_;
        std::string word(ahead.word());
        const size_t sign = word.find_first_of("+-", 1);
        if (sign == std::string::npos || sign + 1 >= word.size() || (word[sign + 1] | 0x20) != 'e')
            return std::nullopt;
        std::swap(word[sign], word[sign + 1]);
        const auto value = TextCursor(word).number();
        if (value)
        {
            countDropped(repaired_);
            text_ = ahead;
        }
        return value;
    }

    /// Continue with the next line after a backslash at the end of a line. True if there was one.
    bool joinLine()
    {
        TextCursor ahead = text_;
        if (!ahead.startsWith('\\'))
            return false;
        ahead.skip(1);
        if (!ahead.atLineEnd() || ahead.atEnd())
            return false;
        ahead.nextLine();
        ahead.skipBlanks();
        text_ = ahead;
        return true;
    }

    static std::string truncateWord(std::string_view word)
    {
        return word.size() <= 40 ? std::string(word) : std::string(word.substr(0, 40)) + "...";
    }

    Status readPosition()
    {
        std::array<double, 8> v{};
        HEARTH_ASSIGN_OR_RETURN(const size_t count, readNumbers(v));
        // x y z [w], or x y z r g b [a]
        if (count != 3 && count != 4 && count != 6 && count != 7)
            return syntax("a vertex of " + std::to_string(count) + " numbers");
        const Float3 position{static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
        if (!isFinite(position))
            return syntax("a coordinate is not finite");
        if (file_.positions.size() == source_.limits.max_vertices)
            return error(Issue::input_too_large,
                         "more than " + std::to_string(file_.positions.size()) + " vertices");
        if (count >= 6)
            addColor({static_cast<float>(v[3]), static_cast<float>(v[4]), static_cast<float>(v[5]), 1});
        else if (!file_.colors.empty())
            file_.colors.push_back({1, 1, 1, 1});
        file_.positions.push_back(position);
        return success();
    }

    void addColor(Float4 color)
    {
        if (!std::isfinite(color.x) || !std::isfinite(color.y) || !std::isfinite(color.z))
        {
            countDropped(bad_colors_);
            color = {1, 1, 1, 1};
        }
        file_.colors.resize(file_.positions.size(), {1, 1, 1, 1}); // earlier vertices have no colour
        file_.colors.push_back(linearColor(color.x, color.y, color.z, color.w));
    }

    Status readNormal()
    {
        std::array<double, 3> v{};
        HEARTH_ASSIGN_OR_RETURN(const size_t count, readNumbers(v));
        if (count != 3)
            return syntax("a normal of " + std::to_string(count) + " numbers");
        file_.normals.push_back(
            {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])});
        return success();
    }

    Status readUv()
    {
        std::array<double, 3> v{};
        HEARTH_ASSIGN_OR_RETURN(const size_t count, readNumbers(v));
        if (count == 0)
            return syntax("a texture coordinate without numbers");
        const Float2 uv{static_cast<float>(v[0]), static_cast<float>(1 - v[1])};
        const bool finite = std::isfinite(uv.x) && std::isfinite(uv.y);
        if (!finite)
            countDropped(bad_uvs_);
        file_.uvs.push_back(finite ? uv : Float2{});
        return success();
    }

    Status readFace()
    {
        const size_t first = file_.corner_positions.size();
        for (text_.skipBlanks(); !text_.atLineEnd() && !text_.startsWith('#'); text_.skipBlanks())
            if (!joinLine())
                HEARTH_TRY(readCorner());
        if (file_.corner_positions.size() - first < 3)
        {
            countDropped(small_faces_);
            shrinkCorners(first);
            return success();
        }
        triangles_ += file_.corner_positions.size() - first - 2;
        if (triangles_ > source_.limits.max_triangles)
            return error(Issue::input_too_large,
                         "more than " + std::to_string(source_.limits.max_triangles) + " triangles");
        file_.face_ends.push_back(static_cast<uint32_t>(file_.corner_positions.size()));
        if (!file_.face_materials.empty() || material_ != kInvalidIndex)
        {
            file_.face_materials.resize(file_.face_ends.size() - 1, kInvalidIndex);
            file_.face_materials.push_back(material_);
        }
        return success();
    }

    void shrinkCorners(size_t size)
    {
        file_.corner_positions.resize(size);
        file_.corner_uvs.resize(std::min(size, file_.corner_uvs.size()));
        file_.corner_normals.resize(std::min(size, file_.corner_normals.size()));
    }

    /// Read "position", "position/uv", "position//normal" or "position/uv/normal"; parts after the first may
    /// be empty.
    Status readCorner()
    {
        std::array<uint32_t, 3> index = {kInvalidIndex, kInvalidIndex, kInvalidIndex};
        for (size_t kind = kPosition; kind <= kNormal; ++kind)
        {
            const bool empty = text_.startsWith('/') || atCornerEnd();
            if (!empty || kind == kPosition)
                HEARTH_TRY(readIndex(kind, index[kind]));
            if (!text_.startsWith('/'))
                break;
            text_.skip(1);
        }
        if (!atCornerEnd())
            return syntax(fmt::format("'{}' follows a corner", truncateWord(text_.word())));
        addIndex(file_.corner_uvs, index[kUv]);
        addIndex(file_.corner_normals, index[kNormal]);
        file_.corner_positions.push_back(index[kPosition]);
        return success();
    }

    bool atCornerEnd() const
    {
        return text_.atLineEnd() || text_.startsWith(' ') || text_.startsWith('\t') ||
               text_.startsWith('\v') || text_.startsWith('\f');
    }

    /// Append the UV or normal index of a corner; indices are stored from the first corner that has one.
    void addIndex(std::vector<uint32_t>& indices, uint32_t index)
    {
        if (indices.empty() && index == kInvalidIndex)
            return;
        indices.resize(file_.corner_positions.size(), kInvalidIndex);
        indices.push_back(index);
    }

    size_t elementCount(size_t kind) const
    {
        return kind == kPosition ? file_.positions.size()
               : kind == kUv     ? file_.uvs.size()
                                 : file_.normals.size();
    }

    /// Read an index: positive numbers count from 1, negative ones back from the last element so far.
    Status readIndex(size_t kind, uint32_t& index)
    {
        const auto number = text_.integer();
        if (!number)
            return syntax(fmt::format("'{}' is not an index", truncateWord(text_.word())));
        const auto count = static_cast<int64_t>(elementCount(kind));
        const int64_t from_zero = *number < 0 ? count + *number : *number - 1;
        if (*number == 0 || from_zero < 0 || from_zero >= kInvalidIndex)
            return error(Issue::index_out_of_range, std::string(kKindNames[kind]) + " index " +
                                                        std::to_string(*number) + " with " +
                                                        std::to_string(count) + " defined");
        if (from_zero >= count && static_cast<uint64_t>(from_zero) >= forward_[kind].index)
            forward_[kind] = {static_cast<uint64_t>(from_zero) + 1, text_.line()};
        index = static_cast<uint32_t>(from_zero);
        return success();
    }

    /// Check forward references: a position must exist, a missing UV or normal is removed from its corner.
    Status checkReferences()
    {
        const ForwardReference& position = forward_[kPosition];
        if (position.index > file_.positions.size())
            return Error{
                Issue::index_out_of_range, source_.path, "line " + std::to_string(position.line),
                fmt::format("vertex index {} with {} in the file", position.index, file_.positions.size())};
        removeMissing(kUv, file_.corner_uvs);
        removeMissing(kNormal, file_.corner_normals);
        return success();
    }

    void removeMissing(size_t kind, std::vector<uint32_t>& indices)
    {
        size_t missing = 0;
        for (uint32_t& index : indices)
            if (index != kInvalidIndex && index >= elementCount(kind))
            {
                index = kInvalidIndex;
                ++missing;
            }
        if (missing > 0)
            file_.note(
                Issue::repaired, "line " + std::to_string(forward_[kind].line),
                fmt::format("{} corners name a {} that the file does not have", missing, kKindNames[kind]));
        if (elementCount(kind) == 0)
            indices.clear();
    }

    void useMaterial(std::string_view name)
    {
        const auto found = material_of_name_.find(name);
        if (found != material_of_name_.end())
        {
            material_ = found->second;
            return;
        }
        material_ = static_cast<uint32_t>(file_.material_names.size());
        file_.material_names.emplace_back(name);
        material_of_name_.emplace(name, material_);
    }

    void countDropped(Occurrences& dropped)
    {
        if (dropped.count++ == 0)
            dropped.first_line = text_.line();
    }

    /// Count a statement that is not supported. Bytes that no text contains mean that the file is not a text.
    Status countUnsupported(std::string_view keyword)
    {
        if (std::any_of(keyword.begin(), keyword.end(), isControlByte))
            return syntax("a byte that no text has");
        constexpr size_t kMaxKinds = 16; // a damaged file could have one for each line
        const auto found = dropped_.find(keyword);
        if (found != dropped_.end())
            ++found->second.count;
        else if (dropped_.size() < kMaxKinds)
            countDropped(dropped_[truncateWord(keyword)]);
        return success();
    }

    void noteDropped(const Occurrences& dropped, Issue issue, const std::string& what)
    {
        if (dropped.count > 0)
            file_.note(issue, "line " + std::to_string(dropped.first_line),
                       std::to_string(dropped.count) + " " + what);
    }

    void finishNotes()
    {
        for (const auto& [keyword, dropped] : dropped_)
            noteDropped(dropped, Issue::dropped, fmt::format("statements '{}' are not kept", keyword));
        noteDropped(small_faces_, Issue::dropped, "faces with fewer than three corners are not kept");
        noteDropped(repaired_, Issue::repaired, "numbers have the sign of the exponent before the letter");
        noteDropped(bad_colors_, Issue::repaired, "vertex colours are not finite and became white");
        noteDropped(bad_uvs_, Issue::repaired, "texture coordinates are not finite and became 0");
    }

    const ScanSource& source_;
    TextCursor text_;
    ScanPolygons file_;
    uint32_t material_ = kInvalidIndex;
    std::map<std::string, uint32_t, std::less<>> material_of_name_;
    uint64_t triangles_ = 0;
    std::array<ForwardReference, 3> forward_{};
    std::map<std::string, Occurrences, std::less<>> dropped_;
    Occurrences small_faces_;
    Occurrences repaired_;
    Occurrences bad_colors_;
    Occurrences bad_uvs_;
};

} // namespace

Result<ScanPolygons> readObj(const ScanSource& source)
{
    return ObjReader(source).read();
}

} // namespace hearth::import
