"""Ways to let a pack hold in a driveline it does not know, as units of the same interface.

``torque = unit.step(slip, h, load)``: torque [N m] for the slip [rad/s] and the load [N] at the
start of a step of ``h`` [s]. ``gain`` is capacity over load [m]. Written to be read and compared;
the way that was taken is the kernel of the clutch itself.
"""

import math

DIP, ROUND, SLOW_SHARE = 0.02, 10, 0.3  # of the torque; steps of a round; of the slow wave
FIRST_DIPS, MOST_DIPS = 20, 400
AGES = (0, 1, 2)
SURE, UNSURE, VAGUE = 0.02, 0.03, 0.15  # relative standard deviations of the inertia
REACH, LARGE, COUNTED, BROAD, OPEN, ROW = 4.0, 0.1, 1e-3, 0.02, 0.02, 30
WIDTH = 0.1  # rad/s, of friction where nothing is known


class Unit:
    """What the ways have in common: what was seen and given (newest first), reversals, work."""

    def __init__(self, gain: float) -> None:
        self.gain, self.capacity, self.energy = gain, 0.0, 0.0
        self.locked = self.warned = False
        self.age = -1  # of the torque, in steps; -1: not known
        self.slips, self.steps, self.torques = [0.0] * 3, [0.0] * 3, [0.0] * 5
        self.count = self.dips = 0
        self.most_slip = self.most = self.swing = self.caution = 0.0
        self.sign, self.reversed, self.before = 0.0, -999, -999

    def see(self, slip: float, load: float) -> None:
        """Take in the slip and the load; three reversals in a row are chatter."""
        self.capacity = self.gain * load
        if not self.count:
            self.stuck = abs(slip) <= WIDTH
        self.most_slip, self.most = max(self.most_slip, abs(slip)), max(self.most, self.capacity)
        if self.count:
            turned = 0.5 * (slip + self.slips[0]) * self.steps[0]
            self.energy += self.torques[max(self.age, 0)] * turned
        self.swing = max(self.swing, abs(self.torques[0] - self.torques[1]))
        self.turns = False
        if abs(slip) > COUNTED * self.most_slip:
            if slip * self.sign < 0.0:
                self.turns = self.swing > 0.5 * self.capacity
                self.swing = 0.0
            self.sign = math.copysign(1.0, slip)
        if self.turns:
            if self.count - self.before < ROW:
                self.warned, self.caution = True, min(0.7, 0.4 + 0.6 * self.caution)
            self.before, self.reversed = self.reversed, self.count

    def give(self, torque: float, slip: float, h: float) -> float:
        """Keep what was seen and return the torque, at most the capacity."""
        self.locked = abs(torque) < self.capacity
        torque = min(max(torque, -self.capacity), self.capacity)
        self.torques = [torque, *self.torques[:4]]
        self.slips, self.steps = [slip, *self.slips[:2]], [h, *self.steps[:2]]
        self.count += 1
        return torque


class Tanh(Unit):
    """Nothing is held: friction passes through zero over ``width`` [rad/s]."""

    def __init__(self, gain: float, width: float = WIDTH) -> None:
        super().__init__(gain)
        self.width = width

    def step(self, slip: float, h: float, load: float) -> float:
        """Return the torque for a step."""
        self.see(slip, load)
        return self.give(self.capacity * math.tanh(slip / self.width), slip, h)


class BoundedGain(Unit):
    """A proportional and integral law without identification.

    The slip falls by ``fall`` in a step at capacity; the gain is a share of capacity over fall.
    The share is halved where the slip reverses, and grows while it does not.
    """

    ON_CHANGE, ON_SLIP, FIRST, MOST, GROWS = 0.2, 0.02, 0.5, 1.0, 1.02  # the best of a search

    def __init__(self, gain: float) -> None:
        super().__init__(gain)
        self.share, self.fall = self.FIRST, 0.0

    def step(self, slip: float, h: float, load: float) -> float:
        """Return the torque for a step."""
        self.see(slip, load)
        torque = math.copysign(self.capacity, slip)
        if self.count:
            last = self.slips[0]
            if not self.locked:
                self.fall = max(abs(slip - last), 1e-6 * self.most_slip) / self.steps[0]
            self.share = min(self.MOST, self.share * (0.5 if self.turns else self.GROWS))
            if self.stuck and self.locked:
                self.fall = WIDTH / h  # nothing is known of it
            stiff = self.share * self.capacity / (self.fall * h)
            if self.locked or abs(slip) < self.fall * h / self.share:
                more = self.ON_CHANGE * (slip - last) + self.ON_SLIP * slip
                torque = self.torques[0] + stiff * more
        return self.give(torque, slip, h)


class Identifying(Unit):
    """The deadbeat law for units that find age and inertia, with what they do until then."""

    inertia = outside = 0.0
    error = math.inf  # relative, of the inertia
    held = 0

    def step(self, slip: float, h: float, load: float) -> float:
        """Return the torque for a step."""
        self.see(slip, load)
        if self.dips and self.capacity < OPEN * self.most:
            self.dips, self.caution = 0, 0.0
            self.doubt()  # the next engagement may be in another driveline
        if self.count:
            self.learn(slip)
        torque, slides = self.wanted(slip, h)
        if abs(torque) < self.capacity:
            slides = slides or self.age < 0
        self.held = 0 if slides or abs(torque) >= self.capacity else self.held + 1
        sliding = abs(torque) > (1.0 - DIP) * self.capacity
        if sliding and (self.dips % ROUND or self.wants_dips()):
            torque = math.copysign(self.capacity, torque) * (1.0 - self.dip())
            self.dips += 1
        return self.give(torque, slip, h)

    def wants_dips(self) -> bool:
        """Tell if another round of dips is to begin."""
        return self.dips < FIRST_DIPS or (self.dips < MOST_DIPS and not self.error < SURE)

    def dip(self) -> float:
        """Return the share of the torque that is left out, two waves over a round."""
        turn = 2.0 * math.pi / ROUND * self.dips
        slow, fast = 1.0 - math.cos(turn), 1.0 - math.cos(3.0 * turn)
        return 0.5 * DIP * (SLOW_SHARE * slow + (1.0 - SLOW_SHARE) * fast)

    def wanted(self, slip: float, h: float) -> tuple[float, bool]:
        """Return the torque that ends the slip, or that of a pack that slides, and if it does."""
        full = math.copysign(self.capacity, slip)
        if self.age < 0:
            torque = self.capacity * math.tanh(slip / max(WIDTH, BROAD * self.most_slip))
            if self.stuck and self.count:  # from the start: no sudden torque
                most = 2.0 * abs(self.torques[0]) + DIP * self.capacity
                torque = min(max(torque, -most), most)
            return torque, True
        share = 1.0 if self.error <= UNSURE else 0.5 if self.error <= VAGUE else 0.3
        share = min(share, 1.0 - self.caution)
        self.outside = self.outside_now(slip, share)
        ahead = slip
        for k in range(self.age):
            ahead += h * (self.outside - self.torques[self.age - 1 - k] / self.inertia)
        longest = max(h, *self.steps) if self.age else h
        torque = self.inertia * (self.outside + share * ahead / longest)
        seen = [slip, *self.slips]
        change = max(abs(seen[i] - seen[i + 1]) for i in range(3))
        reach = REACH * (1.0 + self.age) * change + COUNTED * self.most_slip
        drives = torque * slip < 0.0 and abs(slip) > LARGE * self.most_slip
        if (not self.held or drives) and abs(slip) > reach:
            return full, True
        return torque, False


class KalmanBank(Identifying):
    """A Kalman filter of slip, outside acceleration and 1/inertia for each age of the torque.

    The outside acceleration walks at random. The scale of the noise is not known: the age is that
    whose innovations, over their expected size, are clearly the smallest (likelihood with the scale
    that suits each filter best), and that scale belongs to the standard deviation of 1/inertia.
    """

    NOISE, WALK, KEPT, CLEAR = 1e-6, 1.0, 0.97, 0.25

    def __init__(self, gain: float) -> None:
        super().__init__(gain)
        self.filters: list[list[float]] = []
        self.sums, self.weight = [0.0] * 3, 0.0

    def learn(self, slip: float) -> None:
        """Let each filter see the slip, then judge them."""
        if self.count < 3 or self.most == 0.0 or self.most_slip == 0.0:
            return
        h, noise = self.steps[0], (self.NOISE * self.most_slip) ** 2
        if not self.filters:
            rate = (self.slips[0] - self.slips[1]) / self.steps[1]
            spread, answer = self.most_slip / h, self.most_slip / h / self.most
            first = [self.slips[0], rate, 0.0, noise, 0.0, 0.0, spread**2, 0.0, answer**2]
            self.filters = [list(first) for _ in AGES]
        torques = self.torques
        news = [self.see_slip(self.filters[d], slip, h, torques[d], noise, math.inf) for d in AGES]
        self.weight = self.KEPT * self.weight + 1.0
        self.sums = [self.KEPT * old + new for old, new in zip(self.sums, news, strict=True)]
        best, second, _ = sorted(self.sums)
        age = self.sums.index(best)
        f, scale = self.filters[age], max(1e-6, best / self.weight)
        if f[2] > 0.0 and self.weight > 3.0 and (best < self.CLEAR * second or age == self.age):
            error = math.sqrt(max(f[8], 0.0) * scale) / f[2]
            if error < 0.3:
                self.age, self.error = age, error
        if self.age >= 0 and self.filters[self.age][2] > 0.0:
            self.inertia = 1.0 / self.filters[self.age][2]

    def doubt(self) -> None:
        """Forget 1/inertia."""
        if self.age >= 0:
            self.error = max(self.error, 1.3 * UNSURE)
        for f in self.filters:
            f[5], f[7] = 0.0, 0.0
            f[8] = (self.most_slip / self.steps[0] / self.most) ** 2
        self.sums, self.weight = [0.0] * 3, 0.0

    @staticmethod
    def see_slip(
        f: list[float], slip: float, h: float, torque: float, noise: float, most: float
    ) -> float:
        """One step of a filter: states, then the upper half of their covariances."""
        s, a, b, ss, sa, sb, aa, ab, bb = f
        g = -h * torque
        s += h * a + g * b
        ss += 2.0 * (h * sa + g * sb + h * g * ab) + h * h * aa + g * g * bb
        sa, sb = sa + h * aa + g * ab, sb + h * ab + g * bb
        aa += KalmanBank.WALK * noise / (h * h)
        total, gap = ss + noise, slip - s
        strange = gap * gap / total
        ks, ka, kb = ss / total, sa / total, sb / total
        if strange > most:
            kb = 0.0  # something outside: no news of the inertia
        f[:] = [s + ks * gap, a + ka * gap, b + kb * gap, ss * noise / total, sa * noise / total]
        f += [sb * noise / total, aa - ka * sa, ab - kb * sa, max(bb - kb * sb, 0.0)]
        return strange

    def outside_now(self, slip: float, share: float) -> float:
        """Return the acceleration by all other torques [rad/s2]."""
        return self.filters[self.age][1]


class PlainLeastSquares(Identifying):
    """Least squares of the second differences alone, without the care of the kernel."""

    KEPT, EXCITED, LEVER, CLEAR = 0.97, 0.004, 0.1, 0.25

    def __init__(self, gain: float) -> None:
        super().__init__(gain)
        self.xx, self.xy, self.yy, self.weight = [0.0] * 3, [0.0] * 3, 0.0, 0.0

    def learn(self, slip: float) -> None:
        """Take the newest second difference in, and judge the ages."""
        if self.count < 4:
            return
        seen, h = [slip, *self.slips], self.steps
        rates = [(seen[i] - seen[i + 1]) / h[i] for i in range(3)]
        y, t = rates[0] - 2.0 * rates[1] + rates[2], self.torques
        x = [-(t[d] - 2.0 * t[d + 1] + t[d + 2]) for d in AGES]
        most = max(map(abs, x))
        if not most > self.EXCITED * self.most or self.held > 3 + self.age > 2:
            return
        scale = min(1.0, self.LEVER * self.most / most)
        y *= scale
        for d in AGES:
            self.xx[d] = self.KEPT * self.xx[d] + (scale * x[d]) ** 2
            self.xy[d] = self.KEPT * self.xy[d] + scale * x[d] * y
        self.yy, self.weight = self.KEPT * self.yy + y * y, self.KEPT * self.weight + 1.0
        left = [
            self.yy - max(self.xy[d], 0.0) ** 2 / self.xx[d] if self.xx[d] else self.yy
            for d in AGES
        ]
        left = [max(part, 1e-13 * self.yy) for part in left]
        best, second, _ = sorted(left)
        age = left.index(best)
        if self.weight < 2.5 or not best < self.CLEAR * second or not self.xy[age] > 0.0:
            return
        answer = self.xy[age] / self.xx[age]
        self.age, self.inertia = age, 1.0 / answer
        self.error = math.sqrt(best / max(self.weight - 1.0, 0.5) / self.xx[age]) / answer

    def doubt(self) -> None:
        """Forget most."""
        self.xx, self.xy = [0.05 * x for x in self.xx], [0.05 * x for x in self.xy]
        self.yy, self.weight = 0.05 * self.yy, 0.5 * self.weight
        if self.age >= 0:
            self.error = max(self.error, 1.3 * UNSURE)

    def outside_now(self, slip: float, share: float) -> float:
        """Return the acceleration by all other torques [rad/s2]."""
        now = (slip - self.slips[0]) / self.steps[0] + self.torques[self.age] / self.inertia
        return now if share == 1.0 else self.outside + share * (now - self.outside)
