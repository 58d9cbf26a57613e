// Compiled once per instruction set, like ../cpu/fluid_kernels.cpp and by the same rules. physics/lattice.h has the
// formulas.
#include "kernels.h"

namespace natator::lattice::NATATOR_ISA {
namespace {

using namespace physics;

constexpr int populations = lattice_populations, moments = lattice_moments;

int at(int cx, int cy, int cz) {
    return (cx + 1) + 3 * (cy + 1) + 9 * (cz + 1);
}

bool periodic(const View& view, int axis) {
    return !view.bounces[axis][0] && !view.mirrors[axis][0] && !view.opens[axis][0];
}
/// Inside periodic ends.
int wrapped(int at, int cells) {
    return (at + cells) % cells;
}
/// Whether a row or plane is one of the lattice, or beyond a periodic end.
bool is_there(const View& view, int axis, int at) {
    const int cells = axis == 1 ? view.ny : view.nz;
    return (at >= 0 && at < cells) || (periodic(view, axis) && cells > 1);
}
/// The first cell of a row.
long first_of(const View& view, int y, int z) {
    return (static_cast<long>(z) * view.ny + y) * view.stride + margin;
}

/// Before a body changes it.
void velocity(const Floats (&m)[moments], Floats (&u)[3]) {
    const Floats inverse = 1.0f / (m[0] + 1.0f);
    for (int a = 0; a < 3; ++a) u[a] = m[1 + a] * inverse;
}

template <bool eddies>
void collide_with(const View& view, const LatticeRates& rates, const long* cells, long count, float* to) {
    for (long k = 0; k < count; k += width) {
        Floats m[moments], u[3], change[3];
        for (int lane = 0; lane < width; ++lane) {
            const long cell = cells[k + lane < count ? k + lane : k];
            for (int e = 0; e < moments; ++e) m[e][lane] = view.now[e][cell];
            for (int a = 0; a < 3; ++a) change[a][lane] = view.change[a][cell];
        }
        velocity(m, u);
        for (int a = 0; a < 3; ++a) u[a] += change[a];
        float* const block = to + k / margin * margin * populations + k % margin;
        collide<eddies>(m, u[0], u[1], u[2], rates,
                        [&](int i, Floats f) { __builtin_memcpy(block + i * margin, &f, sizeof f); });
    }
}

/// What a part keeps of moments before the step, which it or another overwrites while they are needed: the planes
/// beside it and, where there are several strips, of each of its own the last row of the strip before this and the
/// first of all.
class Kept {
public:
    Kept(const View& view, int begin, int end, float* room)
        : view_(view), begin_(begin), end_(end), room_(room), rows_(view.rows < view.ny ? end - begin : 0) {}

    /// Numbers of the room that it takes.
    long size() const { return 2L * moments * (rows_ + view_.ny) * view_.stride; }
    /// A row along x.
    float* row(bool first, int e, int z) const { return place(first ? 1 : 0, e, z - begin_, rows_, room_); }
    /// Rows of the plane after the part, or before it.
    float* plane(bool after, int e) const {
        return place(after ? 1 : 0, e, 0, view_.ny, room_ + 2L * moments * rows_ * view_.stride);
    }
    void keep_planes() const {
        for (int side = 0; side < 2; ++side) {
            const bool after = side == 1;
            const int z = after ? end_ : begin_ - 1;
            if (!is_there(view_, 2, z)) continue;
            const long first = first_of(view_, 0, wrapped(z, view_.nz)) - margin;
            for (int e = 0; e < moments; ++e) copy(view_.now[e] + first, view_.ny, plane(after, e));
        }
    }
    void keep_row(bool first, int y, int z) const {
        for (int e = 0; e < moments; ++e) copy(view_.now[e] + first_of(view_, y, z) - margin, 1, row(first, e, z));
    }
    /// Where the moments of a row are now; z may be beside the part, y beside the strip that begins at strip_begin.
    void find_row(int y, int z, int strip_begin, const float* (&to)[moments]) const {
        const int y_inside = wrapped(y, view_.ny);
        for (int e = 0; e < moments; ++e)
            to[e] = z < begin_ || z >= end_ ? plane(z >= end_, e) + static_cast<long>(y_inside) * view_.stride + margin
                    : strip_begin > 0 && y < strip_begin ? row(false, e, z) + margin
                    : strip_begin > 0 && y >= view_.ny   ? row(true, e, z) + margin
                                                         : view_.now[e] + first_of(view_, y_inside, z);
    }

private:
    float* place(int which, int e, int row, int rows, float* room) const {
        return room + (static_cast<long>(which * moments + e) * rows + row) * view_.stride;
    }
    void copy(const float* from, int rows, float* to) const {
        __builtin_memcpy(to, from, sizeof(float) * static_cast<unsigned long>(rows * static_cast<long>(view_.stride)));
    }

    const View& view_;
    int begin_, end_;
    float* room_;
    int rows_;  ///< of each kind
};

/// One part's planes of populations after collision, the last three, of the rows that [begin, end) along y, a strip,
/// get theirs from. Across periodic ends z counts on, and so does y unless these are all rows.
class Planes {
public:
    Planes(const View& view, const LatticeRates& rates, int begin, int end, const Kept& kept, float* room)
        : view_(view), rates_(rates), kept_(kept), begin_(begin), end_(end), room_(room) {}

    template <bool eddies>
    void collide_plane(int z) const;
    void gather_plane(int z) const;

private:
    bool all_rows() const { return end_ - begin_ == view_.ny; }
    long size() const { return static_cast<long>(end_ - begin_ + 2) * view_.stride; }
    float* row(int y, int z) const {
        return room_ + margin + (z + 3) % 3 * populations * size() + static_cast<long>(y - begin_ + 1) * view_.stride +
               margin;
    }
    const float* source(int i, int y, int z) const;

    const View& view_;
    const LatticeRates& rates_;
    const Kept& kept_;
    int begin_, end_;
    float* room_;
};

template <bool eddies>
void Planes::collide_plane(int z) const {
    const long size_of_one = size();
    const int more = all_rows() ? 0 : 1;
    for (int y = begin_ - more; y < end_ + more; ++y) {
        if (!is_there(view_, 1, y)) continue;
        const int inside[2] = {wrapped(y, view_.ny), wrapped(z, view_.nz)};
        const bool has_changes = view_.row_changes[static_cast<long>(inside[1]) * view_.ny + inside[0]] != 0;
        const long first = first_of(view_, inside[0], inside[1]);
        const float* now[moments];
        kept_.find_row(y, z, begin_, now);
        float* to = this->row(y, z);
        for (int x = 0; x < view_.nx; x += width) {
            Floats m[moments], u[3];
            for (int e = 0; e < moments; ++e) m[e] = load_unaligned(now[e] + x);
            velocity(m, u);
            for (int a = 0; has_changes && a < 3; ++a) u[a] += load_unaligned(view_.change[a] + first + x);
            collide<eddies>(m, u[0], u[1], u[2], rates_,
                            [&](int i, Floats f) { __builtin_memcpy(to + i * size_of_one + x, &f, sizeof f); });
        }
    }
}

/// The row that population i of row y comes from: cell x of it is what streams to x. Ends along x are filled in.
const float* Planes::source(int i, int y, int z) const {
    const int cx = i % 3 - 1, cy = i / 3 % 3 - 1, cz = i / 9 - 1;
    int from_y = y - cy, from_z = z - cz, dy = cy, dz = cz;
    bool bounced = false, comes_in = false;
    const auto meet = [&](int axis, int n, int here, int& from, int& d) {
        if (from >= 0 && from < n) return;
        const int end = from < 0 ? 0 : 1;
        if (view_.bounces[axis][end])
            bounced = true;
        else if (view_.opens[axis][end])
            comes_in = true;
        else if (view_.mirrors[axis][end])
            from = here, d = -d;
        else if (axis == 1 && all_rows())
            from = wrapped(from, n);
    };
    meet(1, view_.ny, y, from_y, dy);
    if (view_.nz == 1 && periodic(view_, 2))
        from_z = z;  // plane flow
    else
        meet(2, view_.nz, z, from_z, dz);
    float* const opposite = row(y, z) + (populations - 1 - i) * size();
    if (bounced) return opposite;
    if (comes_in) return view_.inflow[i];
    float* const base = row(from_y, from_z);
    float* const from = base + at(cx, dy, dz) * size();
    if (cx == 0) return from;
    const int end = cx > 0 ? 0 : 1, inside = end == 0 ? 0 : view_.nx - 1, outside = inside - cx;
    from[outside] = view_.bounces[0][end]   ? opposite[inside]
                    : view_.opens[0][end]   ? view_.inflow[i][0]
                    : view_.mirrors[0][end] ? base[at(-cx, dy, dz) * size() + inside]
                                            : from[end == 0 ? view_.nx - 1 : 0];
    return from - cx;
}

void Planes::gather_plane(int z) const {
    if (end_ < view_.ny) kept_.keep_row(false, end_ - 1, z);
    if (begin_ == 0 && !all_rows() && periodic(view_, 1)) kept_.keep_row(true, 0, z);
    for (int y = begin_; y < end_; ++y) {
        const float* from[populations];
        for (int i = 0; i < populations; ++i) from[i] = source(i, y, z);
        const long row = first_of(view_, y, z);
        for (int x = 0; x < view_.nx; x += width) {
            Floats f[populations], m[moments];
            for (int i = 0; i < populations; ++i) f[i] = load_unaligned(from[i] + x);
            moments_of(f, m);
            for (int lane = view_.nx - x; lane < width; ++lane)  // beyond the row's end
                for (int e = 0; e < moments; ++e) m[e][lane] = 0;
            for (int e = 0; e < moments; ++e) __builtin_memcpy(view_.now[e] + row + x, &m[e], sizeof m[e]);
        }
    }
}

template <bool eddies>
void advance_with(const View& view, const LatticeRates& rates, int begin, int end, float* room) {
    const Kept kept(view, begin, end, room);
    for (int y = 0; y < view.ny; y += view.rows) {
        const Planes planes(view, rates, y, y + view.rows < view.ny ? y + view.rows : view.ny, kept,
                            room + kept.size());
        const auto collide_at = [&](int z) {
            if (is_there(view, 2, z)) planes.collide_plane<eddies>(z);
        };
        collide_at(begin - 1);
        collide_at(begin);
        for (int z = begin; z < end; ++z) {
            collide_at(z + 1);
            planes.gather_plane(z);
        }
    }
}

void collide_cells(const View& view, const LatticeRates& rates, const long* cells, long count, float* to) {
    (rates.eddies > 0 ? &collide_with<true> : &collide_with<false>)(view, rates, cells, count, to);
}

void keep(const View& view, int begin, int end, float* room) {
    Kept(view, begin, end, room).keep_planes();
}

void advance(const View& view, const LatticeRates& rates, int begin, int end, float* room) {
    (rates.eddies > 0 ? &advance_with<true> : &advance_with<false>)(view, rates, begin, end, room);
}

}  // namespace

template <class Real>
Kernels<Real> kernels() {
    return {&collide_cells, &keep, &advance};
}
template Kernels<float> kernels<float>();
template Kernels<double> kernels<double>();

}  // namespace natator::lattice::NATATOR_ISA
