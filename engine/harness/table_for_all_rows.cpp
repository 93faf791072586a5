#include <cstring>
#include <filesystem>
#include <fstream>

#include "base/closest_name.hpp"
#include "base/error.hpp"
#include "harness/model_table.hpp"

namespace lobe::harness {

TableRows tableForAllRows(const Brdf& brdf, const std::string& nameOrFile) {
    if (!brdf.table) throw UsageError("--table: " + brdf.name + " has no table");
    std::vector<std::string> names;
    for (auto& [name, rows] : brdf.table->examples()) {
        if (name == nameOrFile) return std::move(rows);
        names.push_back(name);
    }
    if (!brdf.table->fromFile) {
        std::string list;
        for (const std::string& name : names)
            list += (list.empty() ? "" : ", ") + name;
        throw InputError("--table: '" + nameOrFile + "'; expected one of " + list +
                         didYouMean(nameOrFile, names));
    }
    std::error_code failed;
    const auto size = std::filesystem::file_size(nameOrFile, failed);
    constexpr uintmax_t kLargest = uintmax_t{1} << 30;
    if (failed)
        throw InputError(nameOrFile + ": can't be read: " + failed.message() + didYouMean(nameOrFile, names));
    if (size > kLargest)
        throw InputError(nameOrFile + ": " + std::to_string(size) + " bytes; expected at most 1 GiB");
    std::vector<std::byte> bytes(size);
    std::ifstream stream(nameOrFile, std::ios::binary);
    if (!stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
        throw InputError(nameOrFile + ": can't be read: " + std::strerror(errno));
    try {
        return brdf.table->fromFile(bytes);
    } catch (const InputError& error) {
        throw InputError(nameOrFile + ": " + error.what());
    }
}

}  // namespace lobe::harness
