// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/queries/extras_member.h"

#include <cstddef>

namespace hearth::pack
{

namespace
{

/// Text that is read from front to back. Reads nothing beyond its end, where next() is 0.
class JsonText
{
public:
    explicit JsonText(std::string_view text) : text_(text) {}

    char next() const { return at_ < text_.size() ? text_[at_] : '\0'; }
    size_t position() const { return at_; }
    std::string_view from(size_t begin) const { return text_.substr(begin, at_ - begin); }

    void skipSpace()
    {
        while (next() == ' ' || next() == '\t' || next() == '\n' || next() == '\r')
            ++at_;
    }

    /// Skip white space and this character; false if another one is there.
    bool take(char wanted)
    {
        skipSpace();
        if (next() != wanted)
            return false;
        ++at_;
        return true;
    }

    /// Skip a string behind its first quote; false if it does not end.
    bool skipString()
    {
        for (; at_ < text_.size(); ++at_)
            if (text_[at_] == '"')
            {
                ++at_;
                return true;
            }
            else if (text_[at_] == '\\')
                ++at_;
        return false;
    }

    /// Skip a value up to the comma or bracket behind it; false if the text ends before.
    bool skipValue()
    {
        for (size_t depth = 0; at_ < text_.size();)
        {
            const char c = text_[at_];
            const bool opens = c == '{' || c == '[', closes = c == '}' || c == ']';
            if (depth == 0 && (c == ',' || closes))
                return true;
            ++at_;
            depth += opens ? 1 : 0;
            depth -= closes ? 1 : 0;
            if (c == '"' && !skipString())
                return false;
        }
        return false;
    }

private:
    std::string_view text_;
    size_t at_ = 0;
};

std::string_view withoutSpaceBehind(std::string_view text)
{
    const size_t last = text.find_last_not_of(" \t\n\r");
    return last == std::string_view::npos ? std::string_view() : text.substr(0, last + 1);
}

} // namespace

std::string_view findMember(std::string_view json, std::string_view name)
{
    JsonText text(json);
    if (!text.take('{'))
        return {};
    do
    {
        if (!text.take('"'))
            return {};
        const size_t key = text.position();
        if (!text.skipString())
            return {};
        const std::string_view quoted = text.from(key);
        if (!text.take(':'))
            return {};
        text.skipSpace();
        const size_t value = text.position();
        if (!text.skipValue())
            return {};
        if (quoted.substr(0, quoted.size() - 1) == name)
            return withoutSpaceBehind(text.from(value));
    } while (text.take(','));
    return {};
}

} // namespace hearth::pack
