// Compares Json with nlohmann's library: same output, same parsing, same interface.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "cook/json/json_events.h"

#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <sstream>

#include <nlohmann/json.hpp>

namespace hearth::test
{

namespace
{

using Other = nlohmann::ordered_json;

std::string dumpText(const Other& other, int indent, char fill)
{
    return other.dump(indent, fill, false, Other::error_handler_t::replace);
}

/// Random documents: the same value in both libraries.
class Documents
{
public:
    explicit Documents(unsigned seed) : random_(seed) {}

    std::pair<Json, Other> next(int depth)
    {
        switch (below(depth == 0 ? 6 : 8))
        {
        case 0:
            return {nullptr, nullptr};
        case 1:
            return both(below(2) == 0);
        case 2:
            return both(static_cast<int64_t>(random_()) >> below(64));
        case 3:
            return both(uint64_t{random_()} >> below(64));
        case 4:
            return both(number());
        case 5:
            return both(text());
        case 6:
            return array(depth);
        default:
            return object(depth);
        }
    }

private:
    template <typename T>
    static std::pair<Json, Other> both(const T& value)
    {
        return {Json(value), Other(value)};
    }

    size_t below(size_t end) { return random_() % end; }

    /// Return a random number: any bit pattern, or a value that programs commonly have.
    double number()
    {
        const uint64_t bits = random_();
        double value = 0;
        std::memcpy(&value, &bits, sizeof(value));
        return below(2) == 0 ? value : std::round(static_cast<double>(bits % 100000)) / 128;
    }

    /// Return random text: mostly letters; also quotes, control characters and bytes that are UTF-8 only
    /// partly.
    std::string text()
    {
        std::string text;
        for (size_t i = below(12); i > 0; --i)
            text += below(3) > 0    ? std::string(1, static_cast<char>('a' + below(26)))
                    : below(2) == 0 ? std::string("\xC3\xA9\xF0\x9F\x98\x80").substr(below(3), 1 + below(6))
                                    : std::string(1, static_cast<char>(below(256)));
        return text;
    }

    std::pair<Json, Other> array(int depth)
    {
        std::pair<Json, Other> list{Json::array(), Other::array()};
        for (size_t i = below(4); i > 0; --i)
        {
            auto [json, other] = next(depth - 1);
            list.first.push_back(std::move(json));
            list.second.push_back(std::move(other));
        }
        return list;
    }

    std::pair<Json, Other> object(int depth)
    {
        std::pair<Json, Other> object{Json::object(), Other::object()};
        for (size_t i = below(4); i > 0; --i)
        {
            auto [json, other] = next(depth - 1);
            const std::string key = text();
            object.first[key] = std::move(json);
            object.second[key] = std::move(other);
        }
        return object;
    }

    std::mt19937_64 random_;
};

} // namespace

TEST(Json, writesWhatTheLibraryWrites)
{
    Documents documents(1);
    for (int i = 0; i < 3000; ++i)
    {
        const auto [json, other] = documents.next(5);
        for (const int indent : {-1, 0, 1, 2})
            ASSERT_EQ(json.dump(indent), dumpText(other, indent, ' ')) << i;
        ASSERT_EQ(json.dump(1, '\t'), dumpText(other, 1, '\t')) << i;
    }
}

TEST(Json, writesExtremeNumbersAsTheLibrary)
{
    using Limits = std::numeric_limits<double>;
    for (const double value : {0.0,
                               -0.0,
                               1.0,
                               -1.0,
                               0.1,
                               1e15,
                               1e16,
                               123456789012345680.0,
                               1e21,
                               1e-5,
                               1e-7,
                               5e-324,
                               Limits::min(),
                               Limits::max(),
                               Limits::lowest(),
                               Limits::epsilon(),
                               Limits::infinity(),
                               -Limits::infinity(),
                               Limits::quiet_NaN(),
                               9007199254740993.0,
                               double{0.1f},
                               double{1e10f}})
        EXPECT_EQ(Json(value).dump(), Other(value).dump()) << value;
    EXPECT_EQ(Json(1.0).dump(), "1.0");
    EXPECT_EQ(Json(0.1f).dump(), Other(0.1f).dump());
    EXPECT_EQ(Json(std::numeric_limits<int64_t>::min()).dump(), "-9223372036854775808");
    EXPECT_EQ(Json(std::numeric_limits<uint64_t>::max()).dump(), "18446744073709551615");
}

TEST(Json, writesAllBytesOfTextsAsTheLibrary)
{
    for (int a = 0; a < 256; ++a)
        for (int b = 0; b < 256; ++b)
        {
            const std::string text{'x', static_cast<char>(a), static_cast<char>(b), '\x80', 'y'};
            ASSERT_EQ(quoteJson(text), dumpText(Other(text), -1, ' ')) << a << " " << b;
        }
}

TEST(Json, quotesAnyBytes)
{
    EXPECT_EQ(quoteJson("a\"b\n"), R"("a\"b\n")");
    EXPECT_EQ(quoteJson("\xFF"), "\"\xEF\xBF\xBD\"");
}

TEST(Json, readsWhatTheLibraryReads)
{
    Documents documents(2);
    std::mt19937 random(3);
    int whole = 0;
    for (int i = 0; i < 5000; ++i)
    {
        std::string text = documents.next(4).first.dump(i % 3 - 1);
        // half of the texts are damaged
        if (i % 2 == 0)
            text[random() % text.size()] = R"({}[],:"\0e.-x )"[random() % 15];
        const auto json = Json::parse(text);
        const Other other = Other::parse(text, nullptr, false);
        ASSERT_EQ(json.has_value(), !other.is_discarded()) << text;
        if (!json)
            continue;
        ++whole;
        ASSERT_EQ(json->dump(), dumpText(other, -1, ' ')) << text;
        ASSERT_EQ(json->is_number_unsigned(), other.is_number_unsigned()) << text;
    }
    EXPECT_GT(whole, 2500);
}

TEST(Json, refusesWhatIsNoJson)
{
    for (const char* text :
         {"", " ", "{", "[1,]", "01", "1 2", "nul", "\"\x01\"", "\"\xFF\"", "1e999", "{\"a\"}"})
        EXPECT_FALSE(Json::parse(text).has_value()) << text;
    const auto nested = [](size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
    EXPECT_TRUE(Json::parse(nested(1000)).has_value());
    EXPECT_FALSE(Json::parse(nested(1001)).has_value()) << "no text may end the program";
    EXPECT_EQ(Json::parse(R"({"a": 1, "b": 2, "a": 3})")->dump(), R"({"a":3,"b":2})");
}

TEST(Json, isMadeOfBraces)
{
    const std::string name = "n";
    EXPECT_EQ((Json{{"a", 1}, {"b", {1, 2.5, "x"}}}).dump(), R"({"a":1,"b":[1,2.5,"x"]})");
    EXPECT_EQ((Json{{"a", {{"b", nullptr}}}, {name, true}}).dump(), R"({"a":{"b":null},"n":true})");
    EXPECT_EQ((Json{"a", 1, 2}).dump(), R"(["a",1,2])");
    EXPECT_EQ((Json{"a", 1}).dump(), R"(["a",1])");
    EXPECT_EQ((Json{{1, 2}, {3, 4}}).dump(), "[[1,2],[3,4]]");
    EXPECT_EQ(Json::array({{"a", 1}}).dump(), R"([["a",1]])");
    EXPECT_EQ((Json{{"a", 1}, {"a", 2}}).dump(), R"({"a":2})");
    EXPECT_EQ(Json(std::vector<std::string_view>{"a", "b"}).dump(), R"(["a","b"])");
    EXPECT_EQ(Json(std::set<std::string>{"b", "a"}).dump(), R"(["a","b"])");
    EXPECT_EQ(Json(std::map<std::string, std::vector<size_t>>{{"b", {1}}, {"a", {}}}).dump(),
              R"({"a":[],"b":[1]})");
    EXPECT_EQ(Json().dump(), "null");
    EXPECT_EQ(Json::object().dump(2), "{}");
}

TEST(Json, changes)
{
    Json json;
    json["a"]["b"] = 1;
    json["list"].push_back(1);
    json["list"].push_back({{"x", 2}});
    json["a"]["b"] = "in its old place";
    EXPECT_EQ(json.dump(), R"({"a":{"b":"in its old place"},"list":[1,{"x":2}]})");
    json.update({{"c", 3}, {"a", 4}});
    EXPECT_EQ(json.dump(), R"({"a":4,"list":[1,{"x":2}],"c":3})");
    json["list"].back()["x"] = json["list"];
    EXPECT_EQ(json["list"].dump(), R"([1,{"x":[1,{"x":2}]}])");
    json["list"].erase(0);
    json.erase("c");
    json.erase("none");
    json = Json(json["list"][0]);
    EXPECT_EQ(json.dump(), R"({"x":[1,{"x":2}]})");
    json = std::move(json["x"]);
    EXPECT_EQ(json.dump(), R"([1,{"x":2}])");
    const Json taken = std::move(json);
    EXPECT_TRUE(json.is_null()); // NOLINT(bugprone-use-after-move): the contract says so
}

TEST(Json, isLookedInto)
{
    const Json json =
        Json::parse(R"({"n": -1, "u": 7, "d": 2.5, "t": "x", "f": true, "l": [1, 2], "a/b~": {"": [null]}})")
            .value();
    EXPECT_EQ(json["n"].get<int>(), -1);
    EXPECT_EQ(json["n"].get<size_t>(), std::numeric_limits<size_t>::max()) << "as by a cast";
    EXPECT_EQ(json["u"].get<double>(), 7);
    EXPECT_EQ(json["d"].get<int>(), 2);
    EXPECT_EQ(json["l"].get<std::vector<uint32_t>>(), (std::vector<uint32_t>{1, 2}));
    const Json words{{"a", "b"}};
    EXPECT_EQ((words.get<std::map<std::string, std::string>>().at("a")), "b");
    EXPECT_EQ(json.value("t", "none"), "x");
    EXPECT_EQ(json.value("none", 4u), 4u);
    EXPECT_EQ(json.value("none", Json::array()), Json::array());
    EXPECT_EQ(json.find("none"), nullptr);
    EXPECT_EQ(json["l"].find("none"), nullptr);
    EXPECT_TRUE(json["n"].is_number_integer() && !json["n"].is_number_unsigned());
    EXPECT_TRUE(json["u"].is_number_integer() && json["u"].is_number_unsigned());
    EXPECT_FALSE(json["d"].is_number_integer());
    EXPECT_EQ(json.size(), 7u);
    EXPECT_EQ(json["t"].size(), 0u);
    std::string keys;
    for (const auto& [key, value] : json.items())
        keys += key + " ";
    EXPECT_EQ(keys, "n u d t f l a/b~ ");
    EXPECT_EQ(json.resolve("/l/1")->get<int>(), 2);
    EXPECT_TRUE(json.resolve("/a~1b~0//0")->is_null());
    EXPECT_EQ(json.resolve(""), &json);
    for (const char* nowhere : {"/l/2", "/l/x", "/l/", "/none", "/n/0", "l", "/l/-1"})
        EXPECT_EQ(json.resolve(nowhere), nullptr) << nowhere;
    EXPECT_EQ(pointerStep("a/b~"), "/a~1b~0");
    std::ostringstream stream;
    stream << json["l"];
    EXPECT_EQ(stream.str(), "[1,2]");
}

TEST(Json, saysWhatIsWrong)
{
    const Json json{{"text", "x"}, {"list", {1}}, {"large", 1e30}};
    const auto getFault = [](const auto& use)
    {
        try
        {
            use();
        }
        catch (const JsonError& error)
        {
            return std::string(error.what());
        }
        return std::string("none");
    };
    EXPECT_EQ(getFault([&] { json.at("none"); }), "member 'none' is missing");
    EXPECT_EQ(getFault([&] { json["list"].at(1); }), "element 1 is missing");
    EXPECT_EQ(getFault([&] { json["list"].at("x"); }), "a value is an array and must be an object");
    EXPECT_EQ(getFault([&] { json["text"].get<int>(); }), "a value is a string and must be a number");
    EXPECT_EQ(getFault([&] { json["list"][0].get<bool>(); }), "a value is a number and must be a boolean");
    EXPECT_EQ(getFault([&] { json["large"].get<int>(); }), "a number is out of range");
    EXPECT_EQ(getFault([&] { json.value("text", 0); }), "a value is a string and must be a number");
    EXPECT_EQ(getFault([&] { json["text"].begin(); }), "a value is a string and must be an array");
    EXPECT_EQ(getFault([&] { Json().back(); }), "a value is null and must be an array");
    EXPECT_EQ(getFault([&] { Json("x").push_back(1); }), "a value is a string and must be an array");
    EXPECT_EQ(getFault([&] { Json("x").update(json); }), "a value is a string and must be an object");
    EXPECT_EQ(getFault([&] { Json::array()["x"] = 1; }), "a value is an array and must be an object");
    EXPECT_EQ(Json().begin(), Json().end());
    EXPECT_TRUE(Json().items().empty());
}

TEST(Json, isEqualByMeaning)
{
    EXPECT_EQ(Json(1), Json(1u));
    EXPECT_EQ(Json(1), 1.0);
    EXPECT_NE(Json(-1), std::numeric_limits<uint64_t>::max());
    EXPECT_NE(Json(1), "1");
    EXPECT_NE(Json(0), nullptr);
    EXPECT_NE(Json(true), 1);
    EXPECT_EQ((Json{{"a", 1}, {"b", {1, 2}}}), (Json{{"b", {1, 2}}, {"a", 1}}));
    EXPECT_NE((Json{{"a", 1}}), (Json{{"a", 1}, {"b", 1}}));
    EXPECT_NE((Json{{"a", 1}}), (Json{{"b", 1}}));
    EXPECT_NE((Json{1, 2}), (Json{2, 1}));
    EXPECT_EQ(Json("x"), "x");
}

namespace
{

/// Handler that stops at the first string.
class UntilText final : public JsonEvents
{
public:
    bool null() override { return true; }
    bool boolean(bool) override { return true; }
    bool integer(int64_t) override { return true; }
    bool unsignedInteger(uint64_t) override { return true; }
    bool number(double) override { return true; }
    bool string(std::string&) override { return false; }
    bool beginArray() override { return true; }
    bool endArray() override { return true; }
    bool beginObject() override { return true; }
    bool key(std::string&) override { return true; }
    bool endObject() override { return true; }
};

} // namespace

TEST(JsonEvents, tellWhereTheTextIsNoJson)
{
    UntilText events;
    EXPECT_EQ(parseJson("[1, 2, {\"a\": -1.5}]", events), std::nullopt);
    EXPECT_EQ(parseJson("[1, x]", events), 5u);
    EXPECT_EQ(parseJson("[1, ", events), 5u) << "the end, which has been read";
    EXPECT_EQ(parseJson("[\"a\", x]", events), std::nullopt) << "had ended before";
}

} // namespace hearth::test
