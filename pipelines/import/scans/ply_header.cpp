// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/scans/ply_header.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

namespace hearth::import
{

namespace
{

using namespace std::string_view_literals;

// Limits that only stop damaged files: headers of scanners have about ten lines.
constexpr size_t kMaxHeaderBytes = size_t{1} << 20;
constexpr size_t kMaxWords = 6;

std::optional<PlyType> parseType(std::string_view name)
{
    constexpr std::array kNames = {
        std::pair{"char"sv, PlyType::int8},      std::pair{"int8"sv, PlyType::int8},
        std::pair{"uchar"sv, PlyType::uint8},    std::pair{"uint8"sv, PlyType::uint8},
        std::pair{"short"sv, PlyType::int16},    std::pair{"int16"sv, PlyType::int16},
        std::pair{"ushort"sv, PlyType::uint16},  std::pair{"uint16"sv, PlyType::uint16},
        std::pair{"int"sv, PlyType::int32},      std::pair{"int32"sv, PlyType::int32},
        std::pair{"uint"sv, PlyType::uint32},    std::pair{"uint32"sv, PlyType::uint32},
        std::pair{"float"sv, PlyType::float32},  std::pair{"float32"sv, PlyType::float32},
        std::pair{"double"sv, PlyType::float64}, std::pair{"float64"sv, PlyType::float64},
    };
    const auto found =
        std::find_if(kNames.begin(), kNames.end(), [&](const auto& n) { return n.first == name; });
    return found == kNames.end() ? std::nullopt : std::optional(found->second);
}

std::vector<std::string_view> splitWords(std::string_view line)
{
    std::vector<std::string_view> words;
    while (words.size() <= kMaxWords)
    {
        line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
        if (line.empty())
            break;
        const size_t end = std::min(line.find_first_of(" \t"), line.size());
        words.push_back(line.substr(0, end));
        line.remove_prefix(end);
    }
    return words;
}

class HeaderReader
{
public:
    explicit HeaderReader(const ScanSource& source)
        : path_(source.path), text_(source.text().substr(0, kMaxHeaderBytes))
    {
    }

    Result<PlyHeader> read()
    {
        const size_t first_end = text_.find_first_of("\r\n");
        if (text_.substr(0, first_end) != "ply" || first_end == text_.npos)
            return failure("the file does not start with 'ply'");
        // the first line shows the kind of line end: after end_header the data may start with any byte
        line_end_ = text_.substr(first_end).starts_with("\r\n") ? "\r\n"sv : text_.substr(first_end, 1);
        for (;;)
        {
            const auto line = nextLine();
            if (!line)
                return failure("the header does not end; at most " + std::to_string(kMaxHeaderBytes) +
                               " bytes of it are read");
            if (trimmed(*line) == "end_header")
                break;
            if (!line->starts_with("comment") && !line->starts_with("obj_info") && !trimmed(*line).empty())
                HEARTH_TRY(readLine(splitWords(*line)));
            else
                readComment(*line);
        }
        if (!format_seen_)
            return failure("the header has no line 'format'");
        header_.body_offset = position_;
        header_.body_line = line_ + 1;
        return std::move(header_);
    }

private:
    Error failure(std::string detail) const
    {
        return {Issue::mesh_syntax, path_, "line " + std::to_string(std::max<size_t>(line_, 1)),
                std::move(detail)};
    }

    static std::string_view trimmed(std::string_view text)
    {
        text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
        const size_t last = text.find_last_not_of(" \t");
        return text.substr(0, last == text.npos ? 0 : last + 1);
    }

    std::optional<std::string_view> nextLine()
    {
        const size_t end = text_.find(line_end_, position_);
        if (end == text_.npos)
            return std::nullopt;
        const std::string_view line = text_.substr(position_, end - position_);
        position_ = end + line_end_.size();
        ++line_;
        return line;
    }

    void readComment(std::string_view line)
    {
        constexpr std::string_view kTexture = "comment TextureFile ";
        if (line.starts_with(kTexture) && header_.texture_file.empty())
            header_.texture_file = trimmed(line.substr(kTexture.size()));
    }

    Status readLine(const std::vector<std::string_view>& words)
    {
        if (words[0] == "ply" && line_ == 1 && words.size() == 1)
            return success();
        if (words[0] == "format" && words.size() == 3 && !format_seen_)
            return readFormat(words);
        if (words[0] == "element" && words.size() == 3)
            return readElement(words);
        if (words[0] == "property" && (words.size() == 3 || (words.size() == 5 && words[1] == "list")))
            return readProperty(words);
        return failure("the line is not that of a PLY header");
    }

    Status readFormat(const std::vector<std::string_view>& words)
    {
        constexpr std::array kFormatNames = {"ascii"sv, "binary_little_endian"sv, "binary_big_endian"sv};
        const auto found = std::find(kFormatNames.begin(), kFormatNames.end(), words[1]);
        if (found == kFormatNames.end() || words[2] != "1.0")
            return failure("the format is not ascii, binary_little_endian or binary_big_endian 1.0");
        header_.format = static_cast<PlyFormat>(found - kFormatNames.begin());
        format_seen_ = true;
        return success();
    }

    Status readElement(const std::vector<std::string_view>& words)
    {
        PlyElement element;
        element.name = words[1];
        const auto [end, error] =
            std::from_chars(words[2].data(), words[2].data() + words[2].size(), element.count);
        if (error != std::errc() || end != words[2].data() + words[2].size())
            return failure("the count of an element is not a number");
        header_.elements.push_back(std::move(element));
        return success();
    }

    Status readProperty(const std::vector<std::string_view>& words)
    {
        if (header_.elements.empty())
            return failure("a property comes before the first element");
        const bool is_list = words.size() == 5;
        const auto type = parseType(words[is_list ? 3 : 1]);
        const auto count_type = is_list ? parseType(words[2]) : PlyType::uint8;
        if (!type || !count_type || isFloat(*count_type))
            return failure("the type of a property is not known");
        PlyElement& element = header_.elements.back();
        // properties without a meaning ("gap" and the like) may be repeated; the others may not, as their
        // reader checks
        element.properties.push_back({std::string(words.back()), *type, is_list, *count_type});
        return success();
    }

    const std::string& path_;
    std::string_view text_;
    std::string_view line_end_;
    size_t position_ = 0;
    size_t line_ = 0;
    bool format_seen_ = false;
    PlyHeader header_;
};

} // namespace

Result<PlyHeader> readPlyHeader(const ScanSource& source)
{
    return HeaderReader(source).read();
}

} // namespace hearth::import
