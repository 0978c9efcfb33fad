"""How the person moves: joint angles over time, from where the feet are to be.

Lengths and durations of the animations are those of Gazebo's files of the same names: plugins and worlds are tuned to them.
Angles in rad about the person's axes: ``pitch`` about y, positive forward for what stands on its joint and backward for what hangs.
"""

import math
from dataclasses import dataclass, field

import numpy as np
from person_body import ANKLE, HEEL, HIP, HIPS, SHANK, SOLE, THIGH, TOES

REACH = THIGH + SHANK - 0.002


@dataclass
class Frame:
    """``root``: x, y, z of the hips; ``turns``: bone -> (roll, pitch, yaw) against rest."""

    root: tuple
    turns: dict = field(default_factory=dict)
    facing: float = 0.0  # rad, about z


@dataclass(frozen=True)
class Gait:
    """A stride of two steps. ``stance``: the part of it that a foot is on the ground; ``flat``: until when its sole is."""

    stride: float  # m
    landing: float  # m, the ankle before the hips when its foot comes down
    stance: float
    flat: tuple  # from, until
    heel_strike: float  # rad, how far the toes are up then
    push_off: float  # rad, how far the heel is up at the end
    lift: float  # m, of the ankle in mid swing
    bob: float  # m
    low: float  # m, how much lower the hips are than of who stands
    lean: float
    arms: float
    elbows: float
    knees: float = 0.0  # m, that the swinging foot is lifted on top, where the knee bends most


WALK = Gait(1.36, 0.30, 0.62, (0.09, 0.34), 0.30, 1.0, 0.06, 0.018, 0.022, 0.04, 0.36, 0.25)
RUN = Gait(2.29, 0.26, 0.40, (0.05, 0.17), 0.10, 1.05, 0.16, 0.035, 0.06, 0.14, 0.62, 1.35, 0.12)


def smooth(t):
    return t * t * (3.0 - 2.0 * t)


def foot_on_ground(gait, phase):
    """Ankle (x, z) and pitch of a foot that came down at phase 0, x from where its flat sole has the ankle."""
    flat_from, flat_until = gait.flat
    if phase < flat_from:
        pitch = -gait.heel_strike * (1.0 - smooth(phase / flat_from))
        pivot, ankle = np.array([-HEEL, 0.0]), np.array([0.0, SOLE])
    elif phase <= flat_until:
        return 0.0, SOLE, 0.0
    else:
        pitch = gait.push_off * ((phase - flat_until) / (gait.stance - flat_until)) ** 1.6
        pivot, ankle = np.array([TOES, 0.01]), np.array([0.0, SOLE])
    arm = ankle - pivot
    c, s = math.cos(pitch), math.sin(pitch)
    x, z = pivot + np.array([c * arm[0] + s * arm[1], -s * arm[0] + c * arm[1]])
    return x, z, pitch


def foot(gait, phase):
    """Ankle (x, z) as seen from below the hips, pitch of the foot and of its toes."""
    phase %= 1.0
    if phase < gait.stance:
        x, z, pitch = foot_on_ground(gait, phase)
        toes = -max(pitch, 0.0) * 0.85
        return gait.landing + x - gait.stride * phase, z, pitch, toes
    part = (phase - gait.stance) / (1.0 - gait.stance)
    x0, z0, pitch0 = foot_on_ground(gait, gait.stance - 1e-9)
    x0 += gait.landing - gait.stride * gait.stance
    x1, z1, pitch1 = foot_on_ground(gait, 0.0)
    x1 += gait.landing
    ease = smooth(part)
    x = x0 + (x1 - x0) * ease
    z = z0 + (z1 - z0) * ease + gait.lift * math.sin(math.pi * part) ** 2 + gait.knees * math.sin(math.pi * part**0.6) ** 2
    pitch = pitch0 + (pitch1 - pitch0) * smooth(min(part * 1.25, 1.0))
    return x, z, pitch, -0.85 * max(pitch0, 0.0) * (1.0 - smooth(min(2.0 * part, 1.0)))


def leg(x, z, pitch, hips_height, lean=0.0):
    """(thigh, knee, foot) pitches that put the ankle at (x, z) with the foot so; the knee bends forward."""
    down, along = hips_height - HIP - z, x
    far = min(math.hypot(down, along), REACH)
    inner = math.acos(max(-1.0, min(1.0, (THIGH**2 + far**2 - SHANK**2) / (2.0 * THIGH * far))))
    bend = math.pi - math.acos(max(-1.0, min(1.0, (THIGH**2 + SHANK**2 - far**2) / (2.0 * THIGH * SHANK))))
    thigh = -(math.atan2(along, down) + inner)
    return thigh - lean, bend, pitch - thigh - bend


def stride(gait, phase, travelled):
    """One moment of a walk or a run."""
    turns = {}
    wave = 2.0 * math.pi * phase
    height = HIPS - gait.low - gait.bob * math.cos(2.0 * (wave - 2.0 * math.pi * 0.06))
    for side, own in (("Left", phase), ("Right", phase + 0.5)):
        x, z, pitch, toes = foot(gait, own)
        thigh, knee, ankle = leg(x, z, pitch, height)
        turns.update(
            {f"{side}UpLeg": (0, thigh, 0), f"{side}Leg": (0, knee, 0), f"{side}Foot": (0, ankle, 0), f"{side}ToeBase": (0, toes, 0)}
        )
        swing = gait.arms * math.cos(2.0 * math.pi * own)  # back when the leg of its side is before
        out = 0.10 if side == "Left" else -0.10
        turns[f"{side}Arm"] = (out, swing + 0.03, 0)
        turns[f"{side}ForeArm"] = (0, -gait.elbows - 0.5 * max(-swing, 0.0), 0)
    twist = 0.08 * math.cos(wave)
    turns.update(
        {
            "LowerBack": (0, gait.lean, 0),
            "Spine": (0, 0, twist),
            "Spine1": (0, 0, twist),
            "Neck1": (0, -0.5 * gait.lean, -twist),
            "Head": (0, -0.4 * gait.lean, -twist),
        }
    )
    return Frame((travelled, 0.012 * math.sin(wave), height), turns)


def hanging_arms(turns, left=0.0, right=0.0):
    for side, sign, more in (("Left", 1, left), ("Right", -1, right)):
        turns[f"{side}Arm"] = (0.09 * sign, 0.03 + more, 0)
        turns[f"{side}ForeArm"] = (0, -0.22, 0)


def standing(wave, weight=1.0):
    """Breathes, and shifts its weight a little. ``wave``: rad, of the whole animation."""
    turns = {}
    y, height = 0.012 * weight * math.sin(wave), HIPS - 0.004
    for side, sign in (("Left", 1), ("Right", -1)):
        thigh, knee, ankle = leg(0.0, SOLE, 0.0, height)
        roll = math.atan2(y, ANKLE)
        turns.update(
            {f"{side}UpLeg": (roll + 0.02 * sign, thigh, 0), f"{side}Leg": (0, knee, 0), f"{side}Foot": (-roll - 0.02 * sign, ankle, 0)}
        )
    hanging_arms(turns, 0.02 * math.sin(3 * wave), 0.02 * math.sin(3 * wave + 1.0))
    turns.update(
        {"Spine": (0, 0.012 * math.sin(3 * wave), 0.02 * math.sin(wave)), "Head": (0, 0.02 * math.sin(2 * wave), 0.10 * math.sin(wave))}
    )
    return Frame((0.0, y, height), turns)


def seated(part, wave=0.0):
    """From standing (0) to sitting on a chair of 0.45 m (1): the feet stay, the hips go back and down."""
    x, height = -0.36 * smooth(part), HIPS - 0.004 - 0.375 * smooth(part)
    lean = 0.62 * math.sin(math.pi * part) + 0.06 * part
    turns = {}
    for side, sign in (("Left", 1), ("Right", -1)):
        thigh, knee, ankle = leg(-x, SOLE, 0.0, height)
        turns.update(
            {
                f"{side}UpLeg": (0.05 * sign, thigh, 0),
                f"{side}Leg": (0, knee, 0),
                f"{side}Foot": (-0.05 * sign, ankle, 0),
                f"{side}Arm": (0.09 * sign, 0.03 - 0.42 * part - 0.8 * lean * (1 - part), 0),
                f"{side}ForeArm": (0, -0.22 - 0.75 * part, 0),
            }
        )
    turns.update(
        {
            "LowerBack": (0, 0.7 * lean, 0),
            "Spine": (0, 0.3 * lean + 0.012 * math.sin(3 * wave), 0),
            "Neck1": (0, -0.4 * lean, 0),
            "Head": (0, -0.3 * lean, 0.15 * math.sin(wave) * part),
        }
    )
    return Frame((x, 0.0, height), turns)


def talking(wave, quick):
    """Stands, and moves its hands to what it says."""
    frame = standing(wave)
    a, b = math.sin(quick * wave), math.sin((quick + 2) * wave + 0.7)
    frame.turns.update(
        {
            "RightArm": (-0.25 - 0.1 * b, -0.45 - 0.15 * a, 0),
            "RightForeArm": (0.2 * b, -1.25 - 0.3 * a, 0),
            "LeftArm": (0.18 + 0.05 * a, -0.25 - 0.12 * b, 0),
            "LeftForeArm": (0, -0.9 - 0.3 * b, 0),
            "Head": (0.04 * b, 0.06 * a, 0.18 * math.sin(2 * wave)),
        }
    )
    return frame


def moonwalk(phase, travelled):
    """Faces back while it glides on: one flat foot slides, the other stands on its toes."""
    turns = {}
    height = HIPS - 0.03
    for side, own in (("Left", phase % 1.0), ("Right", (phase + 0.5) % 1.0)):
        if own < 0.5:  # slides back on its sole, as far as the body comes
            x, z, pitch = 0.20 - 0.40 * smooth(2.0 * own), SOLE, 0.0
        else:  # stands on its toes while the body goes by
            part = 2.0 * own - 1.0
            pitch = 0.75 * math.sin(math.pi * part) ** 0.7
            x, z = -0.20 + 0.40 * part, SOLE + TOES * math.sin(pitch)
        thigh, knee, ankle = leg(x, z, pitch, height)
        turns.update(
            {
                f"{side}UpLeg": (0, thigh, 0),
                f"{side}Leg": (0, knee, 0),
                f"{side}Foot": (0, ankle, 0),
                f"{side}ToeBase": (0, -max(pitch, 0.0) * 0.9, 0),
            }
        )
    hanging_arms(turns, 0.25 * math.cos(2 * math.pi * phase), -0.25 * math.cos(2 * math.pi * phase))
    turns.update({"LowerBack": (0, 0.05, 0), "Head": (0, 0.1, 0)})
    return Frame((travelled, 0.0, height), turns, math.pi)


def sampled(length, frames, moment):
    """[(time, Frame)]: ``moment(part)`` with part from 0 to 1."""
    return [(length * i / frames, moment(i / frames)) for i in range(frames + 1)]


def animations():
    """Name of a file -> its frames."""
    circle = 2.0 * math.pi
    return {
        "walk": sampled(5.791666, 48, lambda p: stride(WALK, p, 1.36 * p)),
        "run": sampled(7.875, 72, lambda p: stride(RUN, 2.0 * p, 4.58 * p)),
        "moonwalk": sampled(4.625, 48, lambda p: moonwalk(2.0 * p, 1.24 * p)),
        "stand": sampled(8.291667, 36, lambda p: standing(circle * p)),
        "sitting": sampled(6.625, 24, lambda p: seated(1.0, circle * p)),
        "sit_down": sampled(6.625, 36, lambda p: seated(smooth(p))),
        "stand_up": sampled(6.625, 36, lambda p: seated(smooth(1.0 - p))),
        "talk_a": sampled(8.291667, 48, lambda p: talking(circle * p, 5)),
        "talk_b": sampled(8.291667, 48, lambda p: talking(circle * p, 7)),
    }
