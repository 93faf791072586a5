#include "import/json_schema.hpp"

#include <algorithm>
#include <cfloat>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "import/refuse.hpp"

namespace lobe {

using nlohmann::json;
using Kind = ValueRule::Kind;

namespace {

/// The way from the root to a value, written out only when a message needs it.
struct Path {
    const Path* parent = nullptr;
    const std::string* name = nullptr;
    size_t index = 0;

    std::string written() const {
        if (parent == nullptr) {
            return {};
        }
        const std::string before = parent->written();
        if (name == nullptr) {
            return before + "[" + std::to_string(index) + "]";
        }
        return before.empty() ? *name : before + "." + *name;
    }
};

std::string shortNumber(double value) {
    char text[32];
    (void)std::snprintf(text, sizeof text, "%.9g", value);
    return text;
}

template<typename Values, typename Write>
std::string listed(const Values& values, Write write) {
    std::string all;
    for (const auto& value : values) {
        all += (all.empty() ? "" : ", ") + write(value);
    }
    return all;
}

class Check {
public:
    Check(const json& root, const std::string& file) : root_(root), file_(file) {}

    void object(const json& value, const ObjectSchema& schema, const Path& path) const {
        if (!value.is_object()) {
            fail(path, value, "an object");
        }
        for (const PropertyRule& property : schema.properties) {
            const auto found = value.find(property.name);
            const Path here{&path, &property.name};
            if (found != value.end()) {
                this->value(*found, property.rule, here);
            } else if (property.required) {
                refuse(file_, here.written(), "missing", expectation(property.rule));
            }
        }
    }

private:
    void value(const json& value, const ValueRule& rule, const Path& path) const {
        switch (rule.kind) {
            case Kind::boolean:
                require(value.is_boolean(), rule, path, value);
                return;
            case Kind::text:
                require(isText(value, rule), rule, path, value);
                return;
            case Kind::integer:
                require(
                    value.is_number_integer() && inRange(value.get<double>(), rule) && isAmong(value, rule),
                    rule, path, value);
                return;
            case Kind::number:
                require(value.is_number() && inRange(value.get<double>(), rule), rule, path, value);
                return;
            case Kind::index:
                index(value, rule, path);
                return;
            case Kind::array:
                array(value, rule, path);
                return;
            case Kind::object:
                object(value, *rule.schema, path);
                return;
            case Kind::map:
                map(value, rule, path);
                return;
        }
    }

    void array(const json& value, const ValueRule& rule, const Path& path) const {
        if (!value.is_array()) {
            fail(path, value, expectation(rule));
        }
        if (value.size() < rule.minItems || value.size() > rule.maxItems) {
            refuse(file_, path.written(), std::to_string(value.size()) + " elements", expectation(rule));
        }
        for (size_t i = 0; i < value.size(); ++i) {
            this->value(value[i], rule.items.front(), Path{&path, nullptr, i});
        }
    }

    void map(const json& value, const ValueRule& rule, const Path& path) const {
        if (!value.is_object()) {
            fail(path, value, expectation(rule));
        }
        for (const auto& [key, element] : value.items()) {
            this->value(element, rule.items.front(), Path{&path, &key});
        }
    }

    void index(const json& value, const ValueRule& rule, const Path& path) const {
        const auto target = root_.find(rule.target);
        const size_t count = target == root_.end() ? 0 : target->size();
        if (!value.is_number_integer() || value.get<double>() < 0.0 ||
            value.get<double>() >= static_cast<double>(count)) {
            fail(path, value,
                 "an index into " + rule.target + ", which has " + std::to_string(count) + " elements");
        }
    }

    static bool isText(const json& value, const ValueRule& rule) {
        return value.is_string() && (rule.amongTexts.empty() ||
                                     std::find(rule.amongTexts.begin(), rule.amongTexts.end(),
                                               value.get_ref<const std::string&>()) != rule.amongTexts.end());
    }

    static bool isAmong(const json& value, const ValueRule& rule) {
        return rule.amongNumbers.empty() || std::find(rule.amongNumbers.begin(), rule.amongNumbers.end(),
                                                      value.get<int64_t>()) != rule.amongNumbers.end();
    }

    static bool inRange(double value, const ValueRule& rule) {
        return value <= rule.maximum && (rule.aboveMinimum ? value > rule.minimum : value >= rule.minimum);
    }

    static std::string expectation(const ValueRule& rule) {
        switch (rule.kind) {
            case Kind::boolean:
                return "true or false";
            case Kind::text:
                return rule.amongTexts.empty()
                           ? "a text"
                           : "one of " +
                                 listed(rule.amongTexts, [](const std::string& t) { return '"' + t + '"'; });
            case Kind::integer:
                return !rule.amongNumbers.empty()
                           ? "one of " +
                                 listed(rule.amongNumbers, [](int64_t n) { return std::to_string(n); })
                           : "an integer of at least " + shortNumber(rule.minimum) +
                                 (rule.maximum < 0x1p53 ? " and at most " + shortNumber(rule.maximum) : "");
            case Kind::number:
                return numberExpectation(rule);
            case Kind::index:
                return "an index into " + rule.target;
            case Kind::array:
                return rule.minItems == rule.maxItems
                           ? "an array of " + std::to_string(rule.minItems) + " elements"
                       : rule.minItems > 0
                           ? "an array of at least " + std::to_string(rule.minItems) + " elements"
                           : "an array";
            case Kind::object:
            case Kind::map:
                return "an object";
        }
        return {};
    }

    static std::string numberExpectation(const ValueRule& rule) {
        const bool below = rule.minimum > -double{FLT_MAX};
        const bool above = rule.maximum < double{FLT_MAX};
        if (below && above) {
            return "a number in " + shortNumber(rule.minimum) + ".." + shortNumber(rule.maximum);
        }
        if (below) {
            return std::string("a number ") + (rule.aboveMinimum ? "above " : "of at least ") +
                   shortNumber(rule.minimum) + " that a float can hold";
        }
        return "a number that a float can hold";
    }

    void require(bool holds, const ValueRule& rule, const Path& path, const json& value) const {
        if (!holds) {
            fail(path, value, expectation(rule));
        }
    }

    [[noreturn]] void fail(const Path& path, const json& value, const std::string& expected) const {
        const std::string where = path.written();
        refuse(file_, where.empty() ? "JSON text" : where, shown(value), expected);
    }

    const json& root_;
    const std::string& file_;
};

ValueRule ofKind(Kind kind) {
    ValueRule rule;
    rule.kind = kind;
    return rule;
}

}  // namespace

ValueRule boolean() {
    return ofKind(Kind::boolean);
}

ValueRule text() {
    return ofKind(Kind::text);
}

ValueRule oneOf(std::vector<std::string> texts) {
    ValueRule rule = ofKind(Kind::text);
    rule.amongTexts = std::move(texts);
    return rule;
}

ValueRule oneOf(std::vector<int64_t> numbers) {
    ValueRule rule = integer(*std::min_element(numbers.begin(), numbers.end()),
                             *std::max_element(numbers.begin(), numbers.end()));
    rule.amongNumbers = std::move(numbers);
    return rule;
}

ValueRule integer(int64_t minimum, int64_t maximum) {
    ValueRule rule = ofKind(Kind::integer);
    rule.minimum = static_cast<double>(minimum);
    rule.maximum = static_cast<double>(maximum);
    return rule;
}

ValueRule number() {
    return number(-double{FLT_MAX}, double{FLT_MAX});
}

ValueRule number(double minimum, double maximum) {
    ValueRule rule = ofKind(Kind::number);
    rule.minimum = minimum;
    rule.maximum = maximum;
    return rule;
}

ValueRule numberAbove(double minimum) {
    ValueRule rule = number(minimum, double{FLT_MAX});
    rule.aboveMinimum = true;
    return rule;
}

ValueRule indexOf(std::string rootArray) {
    ValueRule rule = ofKind(Kind::index);
    rule.target = std::move(rootArray);
    return rule;
}

ValueRule arrayOf(ValueRule item, size_t minItems, size_t maxItems) {
    ValueRule rule = ofKind(Kind::array);
    rule.items.push_back(std::move(item));
    rule.minItems = minItems;
    rule.maxItems = maxItems;
    return rule;
}

ValueRule objectOf(const ObjectSchema& schema) {
    ValueRule rule = ofKind(Kind::object);
    rule.schema = &schema;
    return rule;
}

ValueRule mapOf(ValueRule value) {
    ValueRule rule = ofKind(Kind::map);
    rule.items.push_back(std::move(value));
    return rule;
}

PropertyRule required(std::string name, ValueRule rule) {
    return {std::move(name), std::move(rule), true};
}

PropertyRule optional(std::string name, ValueRule rule) {
    return {std::move(name), std::move(rule), false};
}

void checkJson(const json& root, const ObjectSchema& schema, const std::string& file) {
    Check(root, file).object(root, schema, Path{});
}

}  // namespace lobe
