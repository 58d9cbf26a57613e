"""A chart with two logarithmic axes, as SVG: what the scripts draw_*.py of the folders below share. Needs Python alone."""
import math


class LogChart:
    """A frame of 480 x 300 and what is drawn in and around it.

    x, y: (least, greatest) value of each axis. left, top, right: pixels around the frame for labels.
    """

    width, height = 480, 300

    def __init__(self, x, y, left=80, top=20, right=40):
        self.x, self.y, self.left, self.top, self.right = x, y, left, top, right
        self.parts = [f'<rect x="{left}" y="{top}" width="{self.width}" height="{self.height}" fill="none" stroke="#888"/>']

    def place(self, x, y):
        """Pixels of a point."""
        across = math.log(x / self.x[0]) / math.log(self.x[1] / self.x[0])
        up = math.log(y / self.y[0]) / math.log(self.y[1] / self.y[0])
        return self.left + across * self.width, self.top + (1 - up) * self.height

    def text(self, at, words, more=""):
        """Words at a place in pixels."""
        self.parts.append(f'<text x="{at[0]:.1f}" y="{at[1]:.1f}" {more}>{words}</text>')

    def line(self, places, style):
        """A line through places in pixels."""
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in places)
        self.parts.append(f'<polyline points="{path}" fill="none" {style}/>')

    def dot(self, at, colour, radius=4, inside=None):
        """A disc; a ring where `inside` is another colour."""
        edge = f' stroke="{colour}"' if inside else ""
        self.parts.append(f'<circle cx="{at[0]:.1f}" cy="{at[1]:.1f}" r="{radius}" fill="{inside or colour}"{edge}/>')

    def key(self, k, colour, words, x=None):
        """Entry k of the key, beside the frame or at pixel x."""
        x = self.left + self.width + 16 if x is None else x
        y = self.top + 18 + 16 * k
        self.dot((x, y), colour)
        self.text((x + 10, y + 4), words)

    def mark_x(self, value, words, grid=None):
        """A label below the frame, with a line of the grid in a colour."""
        x, bottom = self.place(value, self.y[0])
        if grid:
            self.line([(x, bottom), (x, self.top)], f'stroke="{grid}"')
        self.text((x, bottom + 16), words, 'text-anchor="middle"')

    def mark_y(self, value, words, grid=None):
        """The same left of it."""
        x, y = self.place(self.x[0], value)
        if grid:
            self.line([(x, y), (x + self.width, y)], f'stroke="{grid}"')
        self.text((x - 6, y + 4), words, 'text-anchor="end"')

    def name_x(self, words):
        """What the values below the frame are."""
        self.text((self.left + self.width / 2, self.top + self.height + 36), words, 'text-anchor="middle"')

    def svg(self):
        """The whole picture."""
        return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{self.left + self.width + self.right}" '
                f'height="{self.top + self.height + 50}" font-family="sans-serif" font-size="12">'
                '<rect width="100%" height="100%" fill="white"/>' + "\n".join(self.parts) + "</svg>")


def around(values, factor):
    """Limits of an axis that holds the values, so many times less and more."""
    return min(values) / factor, max(values) * factor


def decades(low, high):
    """1, 2 and 5 times the powers of ten between two values, or the powers alone where these are many."""
    first, last = math.floor(math.log10(low)), math.ceil(math.log10(high))
    steps = (1,) if last - first > 3 else (1, 2, 5)
    return [step * 10.0**power for power in range(first, last + 1) for step in steps if low <= step * 10.0**power <= high]
