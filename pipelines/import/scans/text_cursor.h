// Parses the text of a scan line by line. Numbers are read the same in every locale.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace hearth::import
{

/// Read position in a text. A line ends with \n, \r or \r\n.
class TextCursor
{
public:
    explicit TextCursor(std::string_view text) : at_(text.data()), end_(text.data() + text.size()) {}

    bool atEnd() const { return at_ == end_; }
    bool atLineEnd() const { return at_ == end_ || *at_ == '\n' || *at_ == '\r'; }
    bool startsWith(char c) const { return at_ != end_ && *at_ == c; }
    size_t line() const { return line_; }
    size_t remaining() const { return static_cast<size_t>(end_ - at_); }
    std::string where() const { return "line " + std::to_string(line_); }

    void skipBlanks()
    {
        while (at_ != end_ && isBlank(*at_))
            ++at_;
    }

    void skip(size_t count) { at_ += count; }

    /// Go to the start of the next line.
    void nextLine()
    {
        while (!atLineEnd())
            ++at_;
        if (at_ == end_)
            return;
        const bool two = *at_ == '\r' && at_ + 1 != end_ && at_[1] == '\n';
        at_ += two ? 2 : 1;
        ++line_;
    }

    /// Skip blanks and line ends.
    void skipSpace()
    {
        for (skipBlanks(); at_ != end_ && atLineEnd(); skipBlanks())
            nextLine();
    }

    /// Read the characters up to the next blank or line end; empty at a line end.
    std::string_view word()
    {
        skipBlanks();
        const char* start = at_;
        while (!atLineEnd() && !isBlank(*at_))
            ++at_;
        return {start, static_cast<size_t>(at_ - start)};
    }

    /// Read the rest of the line without the blanks around it.
    std::string_view restOfLine()
    {
        skipBlanks();
        const char* start = at_;
        while (!atLineEnd())
            ++at_;
        const char* last = at_;
        while (last != start && isBlank(last[-1]))
            --last;
        return {start, static_cast<size_t>(last - start)};
    }

    /// Read a decimal number that ends at a blank or line end. "nan" and "inf" are numbers too.
    std::optional<double> number()
    {
        skipBlanks();
        const char* start = at_;
        if (at_ != end_ && *at_ == '+')
            ++at_;
        double value = 0;
        const auto [next, error] = std::from_chars(at_, end_, value);
        if (error == std::errc::result_out_of_range)
            value = outOfRange(at_, next);
        if (error == std::errc::invalid_argument || (next != end_ && !isSpace(*next)))
        {
            at_ = start;
            return std::nullopt;
        }
        at_ = next;
        return value;
    }

    /// Read an integer; the characters after it remain.
    std::optional<int64_t> integer()
    {
        int64_t value = 0;
        const auto [next, error] = std::from_chars(at_, end_, value);
        if (error != std::errc())
            return std::nullopt;
        at_ = next;
        return value;
    }

private:
    static bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
    static bool isSpace(char c) { return isBlank(c) || c == '\n' || c == '\r'; }

    /// Return the value of a number beyond the range of doubles: 0 if it is too small, infinity if too large;
    /// a negative exponent decides.
    static double outOfRange(const char* start, const char* end)
    {
        const std::string_view text(start, static_cast<size_t>(end - start));
        const double sign = text.starts_with('-') ? -1 : 1;
        return text.find("e-") != text.npos || text.find("E-") != text.npos ? sign * 0.0 : sign * HUGE_VAL;
    }

    const char* at_;
    const char* end_;
    size_t line_ = 1;
};

/// True for a byte that no text contains: the file is damaged or not a text.
inline bool isControlByte(char c)
{
    return static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r' && c != '\v' &&
           c != '\f';
}

} // namespace hearth::import
