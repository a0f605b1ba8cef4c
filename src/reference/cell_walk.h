// A straight line over the cells of a repeated height field, one cell at a time in the order it crosses them (Amanatides and
// Woo 1987), and the height field's gap to the line inside a cell. All in double.
#pragma once

#include "core/frame.h"
#include "core/height_field.h"
#include "core/vec.h"
#include "core/wrap.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace relievo {

// Height field minus line along a cell, as a function of the parameter s since the cell's entry: gap + s (slope + s bend).
struct CellGap {
    double gap;
    double slope;
    double bend;
    double at(double s) const { return gap + s * (slope + s * bend); }
};

// The line's parameter t runs from 0 at the start. The cell is kept in integers and walls are computed from them, never summed,
// so that no cell is lost or visited twice however long the walk. Intervals are closed: a line that starts on a wall or passes
// through a corner visits every cell it touches on the way, some for no length at all.
class CellWalk {
public:
    // start: in cells (uv * size - 0.5); speed: cells per unit of t, at least one of them finite and nonzero for a walk to move.
    CellWalk(const HeightField& field, Vec2d start, Vec2d speed)
        : CellWalk(field, start, speed, {static_cast<int>(std::floor(start.x)), static_cast<int>(std::floor(start.y))}) {}

    // The same from a given cell, whose closure holds the start.
    CellWalk(const HeightField& field, Vec2d start, Vec2d speed, Vec2i cell)
        : texels_(field.texels.texels.data()), width_(field.width()), height_(field.height()), origin_(cell), speed_(speed),
          inverse_{1 / speed.x, 1 / speed.y}, offset_{start.x - cell.x, start.y - cell.y},
          column_(wrap_index(cell.x, width_)) {
        assert(!field.empty());
        set_rows(wrap_index(cell.y, height_));
        wall_x_ = speed.x != 0 ? ((speed.x > 0 ? 1.0 : 0.0) - offset_.x) * inverse_.x : never;
        wall_y_ = speed.y != 0 ? ((speed.y > 0 ? 1.0 : 0.0) - offset_.y) * inverse_.y : never;
    }

    double entered() const { return entered_; }
    double leaves() const { return std::max(entered_, std::min(wall_x_, wall_y_)); }
    Vec2i cell() const { return {origin_.x + step_x_, origin_.y + step_y_}; }

    double highest_corner() const {
        const int next = column_ + 1 == width_ ? 0 : column_ + 1;
        return std::max(std::max(row_[column_], row_[next]), std::max(row_above_[column_], row_above_[next]));
    }

    // The gap from the cell's entry on, for a line of height z there that gains `climb` of height per unit of t.
    CellGap gap(double z, double climb) const {
        const Vec2d at = entry();
        const int next = column_ + 1 == width_ ? 0 : column_ + 1;
        const double h00 = row_[column_];
        const double b = row_[next] - h00;
        const double c = row_above_[column_] - h00;
        const double d = (row_above_[next] - static_cast<double>(row_above_[column_])) - b;
        return {h00 + b * at.x + c * at.y + d * at.x * at.y - z,
                b * speed_.x + c * speed_.y + d * (at.x * speed_.y + at.y * speed_.x) - climb, d * speed_.x * speed_.y};
    }

    void advance() {
        entered_ = leaves();
        if (wall_x_ <= wall_y_) {
            through_ = Through::x;
            if (speed_.x > 0) {
                ++step_x_;
                column_ = column_ + 1 == width_ ? 0 : column_ + 1;
                wall_x_ = (step_x_ + 1 - offset_.x) * inverse_.x;
            } else {
                --step_x_;
                column_ = column_ == 0 ? width_ - 1 : column_ - 1;
                wall_x_ = (step_x_ - offset_.x) * inverse_.x;
            }
        } else {
            through_ = Through::y;
            if (speed_.y > 0) {
                ++step_y_;
                set_rows(current_row_ + 1 == height_ ? 0 : current_row_ + 1);
                wall_y_ = (step_y_ + 1 - offset_.y) * inverse_.y;
            } else {
                --step_y_;
                set_rows(current_row_ == 0 ? height_ - 1 : current_row_ - 1);
                wall_y_ = (step_y_ - offset_.y) * inverse_.y;
            }
        }
    }

private:
    static constexpr double never = std::numeric_limits<double>::infinity();

    enum class Through { start, x, y };

    // Where the line enters the current cell, in [0,1]; exact on the wall it came through.
    Vec2d entry() const {
        const Vec2d p{offset_.x + speed_.x * entered_ - step_x_, offset_.y + speed_.y * entered_ - step_y_};
        return {through_ == Through::x ? (speed_.x > 0 ? 0.0 : 1.0) : std::clamp(p.x, 0.0, 1.0),
                through_ == Through::y ? (speed_.y > 0 ? 0.0 : 1.0) : std::clamp(p.y, 0.0, 1.0)};
    }

    void set_rows(int row) {
        current_row_ = row;
        row_ = texels_ + static_cast<std::size_t>(row) * static_cast<std::size_t>(width_);
        row_above_ = texels_ + static_cast<std::size_t>(row + 1 == height_ ? 0 : row + 1) * static_cast<std::size_t>(width_);
    }

    const float* texels_;
    int width_;
    int height_;
    Vec2i origin_;
    Vec2d speed_;
    Vec2d inverse_;
    Vec2d offset_;      // of the start, from the corner of the first cell
    int column_;        // wrapped
    int current_row_ = 0;
    const float* row_ = nullptr;
    const float* row_above_ = nullptr;
    int step_x_ = 0;    // cells from the first
    int step_y_ = 0;
    double wall_x_ = never;  // t at which the line meets the cell's far wall
    double wall_y_ = never;
    double entered_ = 0;
    Through through_ = Through::start;
};

}  // namespace relievo
