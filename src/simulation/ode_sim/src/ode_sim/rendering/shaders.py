"""GLSL 3.30 text, written for exactly the lights and outputs that a scene needs: software GL pays for every operation.

Lighting is that of OGRE's fixed pipeline, which Gazebo's materials are made for: emissive + ambient * scene ambient +
sum over lights of attenuation * (diffuse * cos + specular * cos_half^shininess), all in display values (no gamma).
"""
from __future__ import annotations

from typing import Sequence

_VERTEX = """#version 330
in vec3 vertex;
{normal_in}{uv_in}
in vec4 clip0, clip1, clip2, clip3;
{world_in}{look_in}
{outs}
void main() {{
    vec4 p = vec4(vertex, 1.0);
    gl_Position = vec4(dot(clip0, p), dot(clip1, p), dot(clip2, p), dot(clip3, p));
{body}}}
"""

def vertex_shader(flags: frozenset) -> str:
    """``flags``: any of color, specular, textured, position, ident (and depth, which needs nothing here).

    ``base`` is emissive + ambient * scene ambient, and the opacity; ``world`` rows of the model matrix.
    """
    outs, body = [], []
    color = "color" in flags
    if color:
        outs += ["out vec3 n;", "flat out vec4 v_base;", "flat out vec3 v_diffuse;"]
        body += ["n = vec3(dot(world0.xyz, normal * shrink), dot(world1.xyz, normal * shrink), "
                 "dot(world2.xyz, normal * shrink));", "v_base = base;", "v_diffuse = diffuse;"]
    if "specular" in flags:
        outs.append("flat out vec4 v_specular;")
        body.append("v_specular = specular;")
    if "position" in flags:
        outs.append("out vec3 p_W;")
        body.append("p_W = vec3(dot(world0, p), dot(world1, p), dot(world2, p));")
    if "textured" in flags:
        outs.append("out vec2 v_uv;")
        body.append("v_uv = uv;")
    if "ident" in flags:
        outs.append("flat out int v_ident;")
        body.append("v_ident = ident;")
    return _VERTEX.format(
        normal_in="in vec3 normal;\n" if color else "",
        uv_in="in vec2 uv;\n" if "textured" in flags else "",
        world_in="in vec4 world0, world1, world2;\nin vec3 shrink;\n" if color else "",
        look_in=("in vec4 base;\nin vec3 diffuse;\n" if color else "")
        + ("in vec4 specular;\n" if "specular" in flags else "") + ("in int ident;\n" if "ident" in flags else ""),
        outs="\n".join(outs), body="".join(f"    {line}\n" for line in body))


def _light(index: int, kind: str, casts: bool, specular: bool) -> str:
    """One light, unrolled. Uniform layout: position.w range, direction, diffuse, specular, attenuation/spot cosines."""
    u = f"lights[{5 * index}]", f"lights[{5 * index + 1}]", f"lights[{5 * index + 2}]", \
        f"lights[{5 * index + 3}]", f"lights[{5 * index + 4}]"
    lines = []
    if kind == "directional":
        lines += [f"l = -{u[1]}.xyz;", "k = 1.0;"]
    else:
        lines += [f"l = {u[0]}.xyz - p_W;", "float d = length(l);", "l /= d;",
                  f"k = d > {u[0]}.w ? 0.0 : 1.0 / max({u[4]}.x + d * ({u[4]}.y + d * {u[4]}.z), 1e-4);"]
        if kind == "spot":
            lines += [f"k *= pow(clamp((dot(-l, {u[1]}.xyz) - {u[2]}.w) / max({u[1]}.w - {u[2]}.w, 1e-4), 0.0, 1.0), "
                      f"{u[4]}.w);"]
    lines.append("c = max(dot(N, l), 0.0);")
    if casts:
        lines.append("if (c > 0.0) k *= lit();")
    lines.append(f"shine += (k * c) * {u[2]}.rgb;")
    if specular:
        lines.append(f"gloss += (c > 0.0 ? k * pow(max(dot(N, normalize(l + V)), 0.0), v_specular.a) : 0.0) * {u[3]}.rgb;")
    return "    {\n" + "".join(f"        {line}\n" for line in lines) + "    }\n"


_SHADOW = """uniform sampler2DShadow shadow_map;
uniform mat4 shadow_matrix;
float lit() {
    vec3 s = (shadow_matrix * vec4(p_W, 1.0)).xyz;
    if (any(greaterThan(abs(s.xy - 0.5), vec2(0.5)))) return 1.0;
    return texture(shadow_map, vec3(s.xy, clamp(s.z, 0.0, 1.0)));
}
"""


def fragment_shader(flags: frozenset, lights: Sequence[str] = (), shadow_of: int = -1) -> str:
    """``lights``: kind of each light (directional, point, spot); ``shadow_of``: index of the one with a shadow map."""
    head, body, target = ["#version 330"], [], 0
    if "color" in flags:
        specular, textured = "specular" in flags, "textured" in flags
        head += ["in vec3 n;", "flat in vec4 v_base;", "flat in vec3 v_diffuse;",
                 f"layout(location = {target}) out vec4 color;"]
        target += 1
        if lights:
            head.append(f"uniform vec4 lights[{5 * len(lights)}];")
        if specular:
            head += ["flat in vec4 v_specular;", "uniform vec3 eye;"]
        if "position" in flags:
            head.append("in vec3 p_W;")
        if textured:
            head += ["in vec2 v_uv;", "uniform sampler2D image;"]
        if shadow_of >= 0:
            head.append(_SHADOW)
        body += ["vec3 N = normalize(n);", "vec3 shine = vec3(0.0);", "vec3 l;", "float k, c;"]
        if specular:
            body += ["vec3 gloss = vec3(0.0);", "vec3 V = normalize(eye - p_W);"]
        body += [_light(i, kind, i == shadow_of, specular) for i, kind in enumerate(lights)]
        body.append("vec4 seen = vec4(v_base.rgb + v_diffuse * shine, v_base.a);")
        if textured:
            body += ["seen *= texture(image, v_uv);", "if (seen.a < 0.02) discard;"]
        if specular:
            body.append("seen.rgb += v_specular.rgb * gloss;")
        body.append("color = seen;")
    if "depth" in flags:
        head.append(f"layout(location = {target}) out float depth;")
        body.append("depth = 1.0 / gl_FragCoord.w;")  # clip w is the distance along the optical axis
        target += 1
    if "ident" in flags:
        head += ["flat in int v_ident;", f"layout(location = {target}) out float ident;"]
        body.append("ident = float(v_ident);")  # an index below 2^24 is exact in a float
    return "\n".join(head) + "\nvoid main() {\n" + "\n".join(f"    {line}" for line in body) + "\n}\n"
