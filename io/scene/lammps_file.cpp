// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/lammps_file.hpp"

#include "io/text/input_error.hpp"
#include "io/text/input_file.hpp"
#include "io/text/sentence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>

namespace talus
{
namespace
{

using Words = std::vector<std::string>;

Words words_of(std::string_view line)
{
    constexpr std::string_view blanks = " \t\r";
    Words words;
    for (;;) {
        line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
        if (line.empty()) return words;
        words.emplace_back(line.substr(0, line.find_first_of(blanks)));
        line.remove_prefix(words.back().size());
    }
}

/// Rows of words under names, and the lines of the file that they stand in.
struct LammpsTable {
    std::string file;
    Words names;
    std::vector<Words> rows;
    std::vector<std::size_t> lines;

    [[noreturn]] void refuse(std::size_t line, const std::string& sentence) const
    {
        throw InputError(fmt::format("{}:{}: {}", file, line, sentence));
    }

    void add(Words words, std::size_t line)
    {
        if (words.size() != names.size())
            refuse(line, fmt::format("here {} numbers are wanted, not {}", names.size(), words.size()));
        rows.push_back(std::move(words));
        lines.push_back(line);
    }

    double number(std::size_t row, std::size_t column) const
    {
        const auto value = finite_number(rows[row][column]);
        if (!value)
            refuse(lines[row], fmt::format("'{}' is not a finite number", one_line(rows[row][column].substr(0, 40))));
        return *value;
    }
};

/// Reads a file line by line.
class LammpsReader
{
public:
    explicit LammpsReader(const std::filesystem::path& path) : bytes_(read_bytes(path, "a LAMMPS file")), rest_(bytes_)
    {
        table_.file = path.string();
    }

    LammpsTable read()
    {
        const bool is_dump = bytes_.find("ITEM: ATOMS") != std::string::npos;
        is_dump ? read_dump() : read_data();
        if (table_.rows.empty())
            throw InputError(fmt::format("{}: it has no atoms: neither a dump with 'ITEM: ATOMS' nor a data file with "
                                         "'Atoms # sphere'",
                table_.file));
        return std::move(table_);
    }

private:
    std::string bytes_;
    std::string_view rest_, line_;
    std::size_t number_ = 0; ///< of the line
    LammpsTable table_;

    bool next_line()
    {
        if (rest_.empty()) return false;
        line_ = rest_.substr(0, rest_.find('\n'));
        rest_.remove_prefix(std::min(line_.size() + 1, rest_.size()));
        ++number_;
        return true;
    }

    /// Each frame replaces the one before it.
    void read_dump()
    {
        bool of_atoms = false;
        while (next_line()) {
            Words words = words_of(line_);
            if (words.empty()) continue;
            if (words[0] != "ITEM:") {
                if (of_atoms) table_.add(std::move(words), number_);
                continue;
            }
            of_atoms = words.size() > 2 && words[1] == "ATOMS";
            if (!of_atoms) continue;
            table_.names.assign(words.begin() + 2, words.end());
            table_.rows.clear();
            table_.lines.clear();
        }
    }

    /// Sections begin with their name and a blank line.
    void read_data()
    {
        std::map<std::string, Words> velocities; // by id
        std::string section;
        while (next_line()) {
            const Words words = words_of(line_.substr(0, line_.find('#')));
            if (words.empty()) continue;
            if (!finite_number(words[0])) {
                section = words[0];
                const Words comment = words_of(line_.substr(std::min(line_.find('#'), line_.size())));
                const std::string style = comment.empty() ? "#" : comment.back();
                if (section == "Atoms" && style != "#" && style != "sphere")
                    table_.refuse(number_,
                        fmt::format("atoms of the style '{}' have no radii; 'sphere' is read", one_line(style)));
            } else if (section == "Atoms") {
                if (table_.names.empty()) {
                    table_.names = {"id", "type", "diameter", "density", "x", "y", "z"};
                    if (words.size() == 10) table_.names.insert(table_.names.end(), {"image_1", "image_2", "image_3"});
                }
                table_.add(words, number_);
            } else if (section == "Velocities" && words.size() == 7) {
                velocities[words[0]] = words;
            }
        }
        if (velocities.empty()) return;
        table_.names.insert(table_.names.end(), {"vx", "vy", "vz", "wx", "wy", "wz"});
        for (Words& row : table_.rows) {
            const auto found = velocities.find(row[0]);
            for (std::size_t k = 1; k <= 6; ++k) row.push_back(found == velocities.end() ? "0" : found->second[k]);
        }
    }
};

} // namespace

SphereColumns read_lammps(const std::filesystem::path& path)
{
    const auto table = std::make_shared<const LammpsTable>(LammpsReader(path).read());
    return {.names = table->names,
        .rows = table->rows.size(),
        .number = [table](std::size_t row, std::size_t column) { return table->number(row, column); },
        .text = [table](std::size_t row, std::size_t column) { return table->rows[row][column]; },
        .refuse_row = [table](
                          std::size_t row, const std::string& sentence) { table->refuse(table->lines[row], sentence); },
        .refuse = [table](const std::string& sentence) { table->refuse(table->lines.front(), sentence); }};
}

} // namespace talus
