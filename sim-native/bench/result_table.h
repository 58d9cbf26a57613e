#pragma once

#include <cstdint>
#include <fstream>
#include <set>
#include <string>
#include <vector>

namespace natator::bench {

using Row = std::vector<std::string>;

/// Results of a study as CSV, one row at a time: a study that was killed finds the rows it had finished.
/// The first columns of a row are its key.
class ResultTable {
public:
    /// With a path: takes over the rows that the file holds; a last line that was cut off is dropped. Throws InputError
    /// when the file has other columns, std::runtime_error when it can't be written. Without: keeps rows in memory.
    ResultTable(const std::string& path, Row columns, std::size_t key_columns);
    /// Says on standard error how many rows a study found done: none of its work is to be seen then.
    ~ResultTable();
    ResultTable(ResultTable&&) = default;

    bool has(const Row& key) const {
        found_.insert(unasked_.extract(key));
        return keys_.contains(key);
    }
    /// Adds a row and writes it at once. Fields must hold no comma and no line break.
    void add(const Row& row);

    const std::vector<Row>& rows() const { return rows_; }
    /// Header and rows.
    std::string text() const;
    /// Writes header and rows to a file, in place of what it holds. Throws std::runtime_error when that fails.
    void write(const std::string& path) const;

private:
    /// Reads the file's rows; gives the size of its whole lines in bytes, 0 if there is no such file.
    std::uintmax_t take_over(const std::string& path);
    void keep(const Row& row);

    std::string path_;
    Row columns_;
    std::size_t key_columns_;
    std::vector<Row> rows_;
    std::set<Row> keys_;
    mutable std::set<Row> unasked_, found_;  ///< keys of rows that were taken over: not asked for yet, and asked for
    std::ofstream file_;
};

/// The shortest text that reads back as the same number; empty when it is not finite.
std::string number_text(double value);
/// The same to 6 digits, for what was measured.
std::string measured_text(double value);
inline std::string yes_or_no(bool value) {
    return value ? "yes" : "no";
}

/// The fields of one row, then those of another.
Row joined_rows(Row key, const Row& rest);

/// The fields of a line, which commas separate.
Row fields(const std::string& line);

/// The fields with a separator between them.
std::string joined(const Row& row, const std::string& separator);

/// Path of the file that a study writes beside its table: "a/precision.csv" and "orders" give "a/precision-orders.csv".
std::string path_beside(const std::string& path, const std::string& suffix);

}  // namespace natator::bench
