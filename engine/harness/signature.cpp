#include "harness/signature.hpp"

#include <algorithm>
#include <cctype>
#include <set>
#include <utility>

#include "base/error.hpp"

namespace lobe::harness {
namespace {

struct Token {
    std::string text;
    size_t line = 0;  ///< of the whole text, from 0
};

bool isWordLetter(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

bool isName(const Token& token) {
    return isWordLetter(token.text[0]) && std::isdigit(static_cast<unsigned char>(token.text[0])) == 0;
}

/// The text without comments, line ends kept, continued lines joined.
std::string withoutComments(const std::string& text) {
    std::string clean;
    size_t joined = 0;
    for (size_t i = 0; i < text.size(); ++i) {
        if (text.compare(i, 2, "//") == 0) {
            while (i < text.size() && text[i] != '\n')
                ++i;
        } else if (text.compare(i, 2, "/*") == 0) {
            for (i += 2; i < text.size() && text.compare(i, 2, "*/") != 0; ++i)
                if (text[i] == '\n') clean += '\n';
            i += 1;
            clean += ' ';
            continue;
        } else if (text.compare(i, 2, "\\\n") == 0) {
            ++i;
            ++joined;
            continue;
        }
        if (i >= text.size()) break;
        clean += text[i];
        if (text[i] == '\n') clean.append(std::exchange(joined, 0), '\n');
    }
    return clean;
}

std::vector<Token> wordsOf(const std::string& line, size_t number) {
    std::vector<Token> words;
    for (size_t i = 0; i < line.size();) {
        size_t end = i + 1;
        if (isWordLetter(line[i])) {
            while (end < line.size() && isWordLetter(line[end]))
                ++end;
        } else if (std::isspace(static_cast<unsigned char>(line[i])) != 0) {
            i = end;
            continue;
        }
        words.push_back({line.substr(i, end - i), number});
        i = end;
    }
    return words;
}

/// All words outside directives, macros for a single word replaced.
std::vector<Token> tokensOf(const std::string& text) {
    std::vector<Token> tokens;
    std::map<std::string, std::string> macros;
    const std::string clean = withoutComments(text);
    size_t number = 0;
    for (size_t start = 0; start < clean.size(); ++number) {
        const size_t end = std::min(clean.find('\n', start), clean.size());
        const std::vector<Token> words = wordsOf(clean.substr(start, end - start), number);
        start = end + 1;
        if (!words.empty() && words[0].text == "#") {
            if (words.size() == 4 && words[1].text == "define") macros[words[2].text] = words[3].text;
            continue;
        }
        for (const Token& word : words) {
            const auto macro = macros.find(word.text);
            tokens.push_back({macro == macros.end() ? word.text : macro->second, word.line});
        }
    }
    return tokens;
}

const std::set<std::string>& qualifiers() {
    static const std::set<std::string> words{"const",   "in",   "precise", "highp",
                                             "mediump", "lowp", "flat",    "smooth"};
    return words;
}

/// Words that stand before '(' without declaring a function.
bool isKeyword(const std::string& word) {
    static const std::set<std::string> words{"layout", "return", "if",   "for",
                                             "while",  "switch", "else", "struct"};
    return words.contains(word);
}

/// `tokens[from, to)` as "qualifiers TYPE [arrays] NAME [arrays]".
GlslVariable variableOf(const std::vector<Token>& tokens, size_t from, size_t to) {
    GlslVariable variable;
    bool array = false;
    for (; from < to; ++from) {
        const std::string& word = tokens[from].text;
        if (word == "out" || word == "inout") {
            variable.out = true;
            variable.in = word == "inout";
        } else if (word == "[") {
            array = true;
            while (from < to && tokens[from].text != "]")
                ++from;
        } else if (!qualifiers().contains(word)) {
            (variable.type.empty() ? variable.type : variable.name) = word;
        }
    }
    if (array) variable.type += "[]";
    return variable;
}

/// The place of the bracket that closes the one at `open`.
size_t closing(const std::vector<Token>& tokens, size_t open) {
    const std::string opens = tokens[open].text;
    const std::string closes = opens == "(" ? ")" : "}";
    int depth = 0;
    for (size_t i = open; i < tokens.size(); ++i) {
        if (tokens[i].text == opens) ++depth;
        if (tokens[i].text == closes && --depth == 0) return i;
    }
    return tokens.size();
}

std::vector<GlslVariable> parametersOf(const std::vector<Token>& tokens, size_t open, size_t close) {
    std::vector<GlslVariable> parameters;
    size_t from = open + 1;
    for (size_t i = from; i <= close; ++i) {
        if (i != close && tokens[i].text != ",") continue;
        if (i > from) parameters.push_back(variableOf(tokens, from, i));
        from = i + 1;
    }
    if (parameters.size() == 1 && parameters[0].type == "void") parameters.clear();
    return parameters;
}

/// "vec3 a, b[2]; float c;" between the braces.
std::vector<GlslVariable> fieldsOf(const std::vector<Token>& tokens, size_t open, size_t close) {
    std::vector<GlslVariable> fields;
    size_t from = open + 1;
    std::string type;
    for (size_t i = from; i < close; ++i) {
        if (tokens[i].text != "," && tokens[i].text != ";") continue;
        GlslVariable field = variableOf(tokens, from, i);
        const bool array = field.type.ends_with("[]");
        const std::string first = array ? field.type.substr(0, field.type.size() - 2) : field.type;
        if (type.empty()) type = first;
        const std::string name = field.name.empty() ? first : field.name;
        field = {type + (array ? "[]" : ""), name};
        fields.push_back(field);
        from = i + 1;
        if (tokens[i].text == ";") type.clear();
    }
    return fields;
}

/// Components of float, int, uint, bool and their vectors; 0 for other types.
std::pair<GlslScalar, int> shapeOf(const std::string& type) {
    static const std::map<std::string, std::pair<GlslScalar, int>> shapes = [] {
        std::map<std::string, std::pair<GlslScalar, int>> all;
        const std::vector<std::tuple<std::string, std::string, GlslScalar>> kinds{
            {"float", "vec", GlslScalar::floating},
            {"int", "ivec", GlslScalar::integer},
            {"uint", "uvec", GlslScalar::unsignedInteger},
            {"bool", "bvec", GlslScalar::boolean}};
        for (const auto& [scalar, vector, kind] : kinds) {
            all[scalar] = {kind, 1};
            for (int n = 2; n <= 4; ++n)
                all[vector + std::to_string(n)] = {kind, n};
        }
        return all;
    }();
    const auto found = shapes.find(type);
    return found == shapes.end() ? std::pair(GlslScalar::floating, 0) : found->second;
}

}  // namespace

std::string describe(const GlslFunction& function) {
    std::string text = function.result + " " + function.name + "(";
    for (const GlslVariable& parameter : function.parameters) {
        if (!text.ends_with('(')) text += ", ";
        if (parameter.out) text += parameter.in ? "inout " : "out ";
        text += parameter.type + (parameter.name.empty() ? "" : " " + parameter.name);
    }
    return text + ")";
}

GlslDeclarations declarationsOf(const gl::ShaderSource& source) {
    const std::vector<Token> tokens = tokensOf(source.text);
    GlslDeclarations found;
    std::set<std::string> seen;
    for (size_t i = 0; i < tokens.size(); ++i) {
        if (tokens[i].text == "{") {
            i = closing(tokens, i);
        } else if (tokens[i].text == "struct" && i + 2 < tokens.size() && tokens[i + 2].text == "{") {
            const size_t close = closing(tokens, i + 2);
            found.structs[tokens[i + 1].text] = fieldsOf(tokens, i + 2, close);
            i = close;
        } else if (tokens[i].text == "(" && i >= 2 && isName(tokens[i - 1]) &&
                   !isKeyword(tokens[i - 1].text) && (isName(tokens[i - 2]) || tokens[i - 2].text == "]")) {
            const size_t close = closing(tokens, i);
            if (close + 1 < tokens.size() &&
                (tokens[close + 1].text == "{" || tokens[close + 1].text == ";")) {
                const auto& place = source.places.at(std::min(tokens[i].line, source.places.size() - 1));
                GlslFunction function{tokens[i - 2].text == "]" ? "array" : tokens[i - 2].text,
                                      tokens[i - 1].text, parametersOf(tokens, i, close), place.file,
                                      place.line};
                std::string types = function.name;
                for (const GlslVariable& parameter : function.parameters)
                    types += "," + parameter.type;
                if (seen.insert(types).second) found.functions.push_back(std::move(function));
            }
            i = close;
        }
    }
    return found;
}

std::vector<GlslLeaf> leavesOf(const GlslDeclarations& declarations, const std::string& type,
                               const std::string& path) {
    const auto [scalar, count] = shapeOf(type);
    if (count == 1) return {{path, scalar}};
    std::vector<GlslLeaf> leaves;
    leaves.reserve(static_cast<size_t>(count));
    for (int c = 0; c < count; ++c)
        leaves.push_back({path + "." + "xyzw"[c], scalar});
    if (count > 1) return leaves;
    const auto found = declarations.structs.find(type);
    constexpr std::ptrdiff_t kDeepest = 16;
    if (found == declarations.structs.end() || std::count(path.begin(), path.end(), '.') > kDeepest)
        throw InputError(path + " is a " + type +
                         "; expected float, int, uint or bool, a vector of them, or a struct of such");
    for (const GlslVariable& field : found->second) {
        const std::vector<GlslLeaf> inner = leavesOf(declarations, field.type, path + "." + field.name);
        leaves.insert(leaves.end(), inner.begin(), inner.end());
    }
    return leaves;
}

}  // namespace lobe::harness
