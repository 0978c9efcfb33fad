"""GLSL 3.30 text, written for exactly the lights and outputs that a scene needs: software GL pays for every operation.

Lighting is that of OGRE's fixed pipeline, which Gazebo's materials are made for: emissive + ambient * scene ambient +
sum over lights of attenuation * (diffuse * cos + specular * cos_half^shininess), all in display values (no gamma).
"""

from __future__ import annotations

from collections.abc import Sequence

_VERTEX = """#version 330
in vec3 vertex;
{inputs}
in vec4 clip0, clip1, clip2, clip3;
{outputs}
void main() {{
    vec4 p = vec4(vertex, 1.0);
    gl_Position = vec4(dot(clip0, p), dot(clip1, p), dot(clip2, p), dot(clip3, p));
{body}}}
"""


def vertex_shader(flags: frozenset, lights: Sequence[str] = ()) -> str:
    """``flags``: any of color, by_vertex (light is computed here and interpolated), specular, textured, mirror or border
    (of a texture beyond its image), position, ident
    (and depth, which needs nothing here). ``lights``: kind of each, as for :func:`fragment_shader`.

    ``base`` is emissive + ambient * scene ambient, and the opacity; ``world`` rows of the model matrix.
    """
    inputs, outputs, body = [], [], []
    if "color" in flags:
        inputs += ["in vec3 normal;", "in vec4 world0, world1, world2;", "in vec3 shrink;", "in vec4 base;", "in vec3 diffuse;"]
        turned = "vec3(" + ", ".join(f"dot(world{i}.xyz, normal * shrink)" for i in range(3)) + ")"
        if "by_vertex" in flags:
            inputs += [f"uniform vec4 lights[{5 * len(lights)}];"] if lights else []
            outputs.append("out vec4 v_seen;")
            body += [f"vec3 N = normalize({turned});", "vec3 shine = vec3(0.0);", "vec3 l;", "float k, c;"]
            body += [_light(i, kind, False, False) for i, kind in enumerate(lights)]
            body.append("v_seen = vec4(base.rgb + diffuse * shine, base.a);")
        else:
            outputs += ["out vec3 n;", "flat out vec4 v_base;", "flat out vec3 v_diffuse;"]
            body += [f"n = {turned};", "v_base = base;", "v_diffuse = diffuse;"]
    if "specular" in flags:
        inputs.append("in vec4 specular;")
        outputs.append("flat out vec4 v_specular;")
        body.append("v_specular = specular;")
    if "position" in flags:
        outputs.append("out vec3 p_W;")
        body.append("p_W = vec3(dot(world0, p), dot(world1, p), dot(world2, p));")
    if "textured" in flags:
        inputs.append("in vec2 uv;")
        outputs.append("out vec2 v_uv;")
        body.append("v_uv = uv;")
    if "ident" in flags:
        inputs.append("in int ident;")
        outputs.append("flat out int v_ident;")
        body.append("v_ident = ident;")
    return _VERTEX.format(inputs="\n".join(inputs), outputs="\n".join(outputs), body="".join(f"    {line}\n" for line in body))


def _light(index: int, kind: str, casts: bool, specular: bool) -> str:
    """One light, unrolled. Uniform layout: position.w range, direction, diffuse, specular, attenuation/spot cosines."""
    u = (
        f"lights[{5 * index}]",
        f"lights[{5 * index + 1}]",
        f"lights[{5 * index + 2}]",
        f"lights[{5 * index + 3}]",
        f"lights[{5 * index + 4}]",
    )
    lines = []
    if kind == "directional":
        lines += [f"l = -{u[1]}.xyz;", "k = 1.0;"]
    else:
        lines += [
            f"l = {u[0]}.xyz - p_W;",
            "float d = length(l);",
            "l /= d;",
            f"k = d > {u[0]}.w ? 0.0 : 1.0 / max({u[4]}.x + d * ({u[4]}.y + d * {u[4]}.z), 1e-4);",
        ]
        if kind == "spot":
            lines += [f"k *= pow(clamp((dot(-l, {u[1]}.xyz) - {u[2]}.w) / max({u[1]}.w - {u[2]}.w, 1e-4), 0.0, 1.0), {u[4]}.w);"]
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


# Of the colour behind the fog, by the distance z along the optical axis: the part that is left. fog: start, end, density.
_FOGS = {"linear": "clamp((fog.y - z) / (fog.y - fog.x), 0.0, 1.0)", "exp": "exp(-fog.z * z)", "exp2": "exp(-fog.z * fog.z * z * z)"}


def fragment_shader(flags: frozenset, lights: Sequence[str] = (), shadow_of: int = -1, fog: str = "") -> str:
    """``flags``: as for :func:`vertex_shader`; ``lights``: kind of each light (directional, point, spot).

    ``shadow_of``: index of the one with a shadow map, -1 for none. ``fog``: linear, exp, exp2, '' for none.
    """
    head, body, target = ["#version 330"], [], 0
    if "color" in flags:
        specular, textured = "specular" in flags, "textured" in flags
        head.append(f"layout(location = {target}) out vec4 color;")
        target += 1
        if "by_vertex" in flags:
            head.append("in vec4 v_seen;")
            body.append("vec4 seen = v_seen;")
        else:
            head += ["in vec3 n;", "flat in vec4 v_base;", "flat in vec3 v_diffuse;"]
            head += [f"uniform vec4 lights[{5 * len(lights)}];"] if lights else []
            head += ["flat in vec4 v_specular;", "uniform vec3 eye;"] if specular else []
            head += ["in vec3 p_W;"] if "position" in flags else []
            head += [_SHADOW] if shadow_of >= 0 else []
            body += ["vec3 N = normalize(n);", "vec3 shine = vec3(0.0);", "vec3 l;", "float k, c;"]
            body += ["vec3 gloss = vec3(0.0);", "vec3 V = normalize(eye - p_W);"] if specular else []
            body += [_light(i, kind, i == shadow_of, specular) for i, kind in enumerate(lights)]
            body.append("vec4 seen = vec4(v_base.rgb + v_diffuse * shine, v_base.a);")
        if textured:
            head += ["in vec2 v_uv;", "uniform sampler2D image;", "uniform float alpha_above;"]
            # not by what its own derivatives say, which jump where the image is turned over
            mirrored = "textureGrad(image, 1.0 - abs(mod(v_uv, 2.0) - 1.0), dFdx(v_uv), dFdy(v_uv))"
            seen = mirrored if "mirror" in flags else "texture(image, v_uv)"
            outside = " * float(all(lessThanEqual(abs(v_uv - 0.5), vec2(0.5))))" if "border" in flags else ""
            body += [f"seen *= {seen}{outside};", "if (seen.a <= alpha_above) discard;"]
        if specular:
            body.append("seen.rgb += v_specular.rgb * gloss;")
        if fog:
            head += ["uniform vec3 fog, fog_color;"]
            body += ["float z = 1.0 / gl_FragCoord.w;", f"seen.rgb = mix(fog_color, seen.rgb, {_FOGS[fog]});"]
        body.append("color = seen;")
    if "depth" in flags:
        head.append(f"layout(location = {target}) out float depth;")
        body.append("depth = 1.0 / gl_FragCoord.w;")  # clip w is the distance along the optical axis
        target += 1
    if "ident" in flags:
        head += ["flat in int v_ident;", f"layout(location = {target}) out float ident;"]
        body.append("ident = float(v_ident);")  # an index below 2^24 is exact in a float
    return "\n".join(head) + "\nvoid main() {\n" + "\n".join(f"    {line}" for line in body) + "\n}\n"
