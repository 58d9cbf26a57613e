#include "result_table.h"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <sstream>

#include "base/text.h"
#include "base/whole_file.h"
#include "natator/error.h"

namespace natator::bench {
namespace {

std::string line_of(const Row& row) {
    return joined(row, ",") + "\n";
}

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
    throw InputError("file " + natator::quoted(path) + ": " + what + "; must be a table of this study, or a new name");
}

}  // namespace

ResultTable::ResultTable(const std::string& path, Row columns, std::size_t key_columns)
    : path_(path), columns_(std::move(columns)), key_columns_(key_columns) {
    if (path.empty()) return;
    const std::uintmax_t whole_lines = take_over(path);
    if (whole_lines > 0) std::filesystem::resize_file(path, whole_lines);
    file_.open(path, whole_lines > 0 ? std::ios::app : std::ios::trunc);
    if (whole_lines == 0) file_ << text() << std::flush;
    if (!file_) throw cannot_be_written(path);
}

ResultTable::~ResultTable() {
    if (!found_.empty())
        std::cerr << path_ << ": holds " << found_.size()
                  << " of these rows already, which are kept; with another file they are measured again\n";
}

std::uintmax_t ResultTable::take_over(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::string line;
    // getline meets the end of the file only in a line without its line break: that one was cut off.
    if (!file || !std::getline(file, line)) return 0;
    const std::string columns = line_of(columns_);
    if (file.eof() && columns.starts_with(line)) return 0;
    if (file.eof() || line + "\n" != columns) refuse(path, "holds other columns than this study writes");
    std::uintmax_t whole_lines = line.size() + 1;
    while (std::getline(file, line) && !file.eof()) {
        const Row row = fields(line);
        if (row.size() != columns_.size()) refuse(path, "a row has another number of fields: " + line);
        keep(row);
        whole_lines += line.size() + 1;
    }
    unasked_ = keys_;
    return whole_lines;
}

void ResultTable::keep(const Row& row) {
    keys_.insert(Row(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(key_columns_)));
    rows_.push_back(row);
}

void ResultTable::add(const Row& row) {
    if (row.size() != columns_.size()) throw std::logic_error("a row of " + std::to_string(row.size()) + " fields");
    keep(row);
    if (path_.empty()) return;
    file_ << line_of(row) << std::flush;
    if (!file_) throw cannot_be_written(path_);
}

std::string ResultTable::text() const {
    std::string text = line_of(columns_);
    for (const Row& row : rows_) text += line_of(row);
    return text;
}

void ResultTable::write(const std::string& path) const {
    WholeFile file(path);
    file.stream() << text();
    if (!file.finish()) throw cannot_be_written(path);
}

Row fields(const std::string& line) {
    Row row;
    std::size_t begin = 0;
    for (std::size_t comma = line.find(','); comma != std::string::npos; comma = line.find(',', begin)) {
        row.push_back(line.substr(begin, comma - begin));
        begin = comma + 1;
    }
    row.push_back(line.substr(begin));
    return row;
}

std::string joined(const Row& row, const std::string& separator) {
    std::string text;
    for (std::size_t i = 0; i < row.size(); ++i) text += (i == 0 ? "" : separator) + row[i];
    return text;
}

std::string number_text(double value) {
    if (!std::isfinite(value)) return "";
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string measured_text(double value) {
    if (!std::isfinite(value)) return "";
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value, std::chars_format::general, 6).ptr};
}

Row joined_rows(Row key, const Row& rest) {
    key.insert(key.end(), rest.begin(), rest.end());
    return key;
}

std::string path_beside(const std::string& path, const std::string& suffix) {
    const std::filesystem::path file(path);
    return (file.parent_path() / (file.stem().string() + "-" + suffix + ".csv")).string();
}

}  // namespace natator::bench
