#include "harness/unit/test_file.hpp"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <set>

#include "base/byte_order_mark.hpp"
#include "base/closest_name.hpp"
#include "base/error.hpp"
#include "harness/unit/directive_block.hpp"
#include "harness/unit/test_function.hpp"

namespace lobe::harness {
namespace {

constexpr int64_t kMostRows = int64_t{1} << 32;

std::vector<std::string> readLines(const std::filesystem::path& path) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
        throw InputError(path.string() + ": is a folder; expected a GLSL file");
    std::ifstream stream(path, std::ios::binary);
    if (!stream) throw InputError(path.string() + ": can't be read: " + std::strerror(errno));
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);)
        lines.push_back(lines.empty() ? withoutByteOrderMark(line) : line);
    return lines;
}

GlslType requireType(const std::string& name, const FunctionHead& head, const std::string& file) {
    const std::optional<GlslType> type = parseGlslType(name);
    if (!type)
        throw InputError(file + ":" + std::to_string(head.line) + ": " + head.name + ": tests can't use " +
                         name + "; expected float, int, uint, bool or a vector of them");
    return *type;
}

/// The model's name in "FooBarParams": the one whose GLSL type that is.
const Brdf* modelOfParameters(const std::string& type) {
    for (const Brdf& brdf : allBrdfs())
        if (glslParameterType(brdf) == type) return &brdf;
    return nullptr;
}

/// (Dirs d, WardParams p): inputs are the directions and the model's parameters.
bool addModelInputs(const FunctionHead& head, TestCase& test) {
    if (head.parameters.size() != 2 || head.parameters[0].first != "Dirs") return false;
    test.model = modelOfParameters(head.parameters[1].first);
    if (test.model == nullptr) return false;
    test.inputs.push_back({"wi", {GlslType::Base::real, 3}, {}, 0});
    test.inputs.push_back({"wo", {GlslType::Base::real, 3}, {}, 0});
    for (const Parameter& parameter : test.model->parameters)
        test.inputs.push_back({parameter.glslName, *parseGlslType(glslType(parameter.kind)), {}, 0});
    return true;
}

class TestReader {
public:
    TestReader(const DirectiveBlock& block, const FunctionHead& head, const TestFile& file)
        : block_(block), head_(head), folder_(file.path.parent_path()) {
        test_.name = test_.function = head.name;
        test_.place = {file.name, head.line};
    }

    TestCase read() {
        if (head_.result != "void") test_.result = requireType(head_.result, head_, test_.place.file);
        if (!addModelInputs(head_, test_))
            for (const auto& [type, name] : head_.parameters)
                test_.inputs.push_back({name, requireType(type, head_, test_.place.file), {}, 0});
        for (const Directive& directive : block_.directives)
            take(directive);
        finish();
        return std::move(test_);
    }

private:
    void take(const Directive& directive) {
        DirectiveReader reader = directive.reader();
        if (directive.name == "test") {
            if (!reader.atEnd()) test_.name = reader.untilSpace("the test's name");
            reader.expectEnd();
        } else if (directive.name == "tag") {
            while (!reader.atEnd())
                test_.tags.push_back(reader.untilSpace("a tag"));
        } else if (directive.name == "in") {
            takeInput(reader);
        } else if (directive.name == "expect") {
            takeExpectation(reader);
        } else if (directive.name == "must_fail") {
            test_.mustFail = reader.rest();
            if (test_.mustFail->empty()) reader.fail("expected the reason why it must fail");
        } else if (directive.name == "stage") {
            const std::string stage = reader.word("fragment or vertex");
            if (stage != "fragment" && stage != "vertex")
                reader.fail("expected fragment or vertex" + didYouMean(stage, {"fragment", "vertex"}));
            test_.stage = stage == "vertex" ? Stage::vertex : Stage::fragment;
            reader.expectEnd();
        } else if (directive.name == "model") {
            requireModel(reader, reader.word("the name of a model"));
            reader.expectEnd();
        } else {
            const int64_t number = reader.whole(directive.name == "seed" ? 0 : 1, kMostRows);
            (directive.name == "seed" ? seed_ : test_.rows) = number;
            reader.expectEnd();
        }
    }

    void requireModel(DirectiveReader& reader, const std::string& name) const {
        const Brdf* model = findBrdf(name);
        if (model == nullptr) reader.fail("unknown model '" + name + "'" + didYouMean(name, brdfNames()));
        if (test_.model != model)
            reader.fail("the function must take (Dirs d, " + glslParameterType(*model) + " p)");
    }

    void takeInput(DirectiveReader& reader) {
        const std::string name = reader.word("the name of an input");
        reader.expect(':');
        std::vector<std::string> names;
        for (TestInput& input : test_.inputs) {
            names.push_back(input.name);
            if (input.name != name) continue;
            if (input.generator) reader.fail(name + " has a generator already");
            // The type may be repeated: "@in x: float uniform(0, 1)".
            if (!reader.acceptWord(input.type.name())) refuseOtherType(reader, input);
            input.generator = Generator::parse(reader, input.type, folder_);
            reader.expectEnd();
            return;
        }
        reader.fail(head_.name + " has no parameter '" + name + "'" + didYouMean(name, names));
    }

    static void refuseOtherType(DirectiveReader& reader, const TestInput& input) {
        DirectiveReader ahead = reader;
        const std::string word = ahead.word("a generator");
        if (parseGlslType(word)) reader.fail(input.name + " is a " + input.type.name() + ", not a " + word);
    }

    void takeExpectation(DirectiveReader& reader) {
        if (!test_.result || test_.result->base == GlslType::Base::boolean)
            reader.fail(
                "a " + head_.result +
                " function has no value to compare: it holds what check functions and its result say");
        Expectation expectation = Expectation::parse(reader, *test_.result, folder_);
        if (expectation.kind == Expectation::Kind::twin) {
            if (!expectation.model.empty()) requireModel(reader, expectation.model);
            if (test_.model == nullptr || test_.result->name() != "vec3")
                reader.fail("the function must be of the form vec3 test(Dirs d, NAMEParams p)");
        }
        if (expectation.kind == Expectation::Kind::monotone) {
            if (test_.monotone() != nullptr) reader.fail("only one monotone expectation a test");
            resolveMonotone(reader, expectation);
        }
        test_.expectations.push_back(std::move(expectation));
    }

    void resolveMonotone(DirectiveReader& reader, Expectation& expectation) const {
        std::vector<std::string> names;
        for (const TestInput& input : test_.inputs) {
            if (input.type.components == 1 && input.type.base != GlslType::Base::boolean)
                names.push_back(input.name);
        }
        if (expectation.input.empty() && test_.inputs.size() == 1 && names.size() == 1)
            expectation.input = names[0];
        if (std::find(names.begin(), names.end(), expectation.input) == names.end())
            reader.fail(expectation.input.empty() ? "say in which input: monotone increasing in x"
                                                  : "no single number named '" + expectation.input + "'" +
                                                        didYouMean(expectation.input, names));
    }

    void finish() {
        const auto fail = [&](const std::string& problem) {
            throw InputError(test_.place.text() + ": " + test_.name + ": " + problem);
        };
        if (seed_) test_.seed = static_cast<uint64_t>(*seed_);
        int offset = 0;
        for (TestInput& input : test_.inputs) {
            input.offset = offset;
            offset += input.type.components;
            if (!input.generator && test_.model == nullptr)
                fail("no generator for input '" + input.name + "'; expected '/// @in " + input.name +
                     ": ...'");
        }
        const bool isProperty = !test_.result || test_.result->base == GlslType::Base::boolean;
        if (!isProperty && test_.expectations.empty())
            fail("nothing is expected; '/// @expect finite' is the least");
        const Expectation* monotone = test_.monotone();
        if (monotone != nullptr && !test_.monotoneInput().generator)
            fail("monotone in " + monotone->input + " needs a generator for it");
        checkCsv(fail);
    }

    /// One file's rows are inputs and references together.
    void checkCsv(const std::function<void(const std::string&)>& fail) const {
        std::set<std::string> files;
        for (const TestInput& input : test_.inputs)
            if (input.generator && !input.generator->csvFile().empty())
                files.insert(input.generator->csvFile().string());
        if (files.size() > 1) fail("inputs from two CSV files; expected one");
        for (const Expectation& expectation : test_.expectations)
            if (expectation.csv && !files.contains(expectation.csv->file.string()))
                fail("a reference from a CSV file needs an input from the same file");
    }

    const DirectiveBlock& block_;
    const FunctionHead& head_;
    std::filesystem::path folder_;
    std::optional<int64_t> seed_;
    TestCase test_;
};

void collectCsvFiles(const TestCase& test, std::set<std::filesystem::path>& files) {
    for (const TestInput& input : test.inputs)
        if (input.generator && !input.generator->csvFile().empty()) files.insert(input.generator->csvFile());
}

}  // namespace

int TestCase::width() const {
    int width = 0;
    for (const TestInput& input : inputs)
        width += input.type.components;
    return width;
}

const Expectation* TestCase::monotone() const {
    for (const Expectation& expectation : expectations)
        if (expectation.kind == Expectation::Kind::monotone) return &expectation;
    return nullptr;
}

const TestInput& TestCase::monotoneInput() const {
    const std::string& wanted = monotone()->input;
    return *std::find_if(inputs.begin(), inputs.end(),
                         [&](const TestInput& input) { return input.name == wanted; });
}

TestFile readTestFile(const std::filesystem::path& path) {
    TestFile file{path, path.lexically_normal().generic_string(), {}, {}};
    const std::vector<std::string> lines = readLines(path);
    std::set<std::string> names;
    std::set<std::filesystem::path> csvFiles;
    for (const DirectiveBlock& block : directiveBlocks(lines, file.name)) {
        const bool isTest = std::any_of(block.directives.begin(), block.directives.end(),
                                        [](const Directive& directive) { return directive.name == "test"; });
        const SourcePlace& place = block.directives.front().place;
        if (!isTest) throw InputError(place.text() + ": directives without @test");
        const FunctionHead head = readFunctionHead(lines, block.end, place);
        file.tests.push_back(TestReader(block, head, file).read());
        const TestCase& test = file.tests.back();
        if (!names.insert(test.name).second)
            throw InputError(test.place.text() + ": a second test named " + test.name);
        collectCsvFiles(test, csvFiles);
    }
    file.csvFiles.assign(csvFiles.begin(), csvFiles.end());
    return file;
}

}  // namespace lobe::harness
