"""A neutral scene → the text that `rtc` compiles, and its meshes."""

import mesh_files
import meshes
import model


def numbers(values):
    return "(" + ", ".join(f"{v:.9g}" for v in values) + ")"


def color(values):
    return "linear" + numbers(values)


def material(name, m):
    match m:
        case model.Diffuse():
            body = f"diffuse {{ color = {color(m.color)} }}"
        case model.Metal():
            body = f"conductor {{ color = linear(1), roughness = {m.roughness:.9g}, compensation = off }}"
        case model.Glass():
            inside = f", interior = in_{name}" if m.interior else ""
            body = f"dielectric {{ ior = {m.ior}{inside} }}"
        case _:
            raise TypeError(m)
    return f"material {name}: {body}"


def medium(name, m):
    fields = [f"{key} = {numbers(v)}/m" for key, v in (("sigma_a", m.sigma_a), ("sigma_s", m.sigma_s)) if any(v)]
    fields += [f"g = {m.g}"] if m.g else []
    return f"medium in_{name}: homogeneous {{ {', '.join(fields)} }}"


def shape(s):
    match s:
        case model.Sphere():
            return f"sphere(radius: {s.radius}m)"
        case model.Rectangle():
            return f"rectangle(size: {numbers((s.x, s.z))}m)"
        case model.Box():
            return f"box(size: {numbers((s.x, s.y, s.z))}m)"
        case model.Mesh():
            return s.name
    raise TypeError(s)


def thing(name, material, t):
    return (f"instance {name} {{ shape = {shape(t.shape)}, material = {material}, at = {numbers(t.at)}m, "
            f"rotate = {numbers(t.rotate)}deg }}")


def light(index, s):
    """Lines of a light: a sphere is a light of its own, a rectangle a thing that glows."""
    match s:
        case model.SphereLight():
            where = f"center = {numbers(s.at)}m, radius = {s.shape.radius}m"
            return [f"light lamp{index}: sphere {{ {where}, color = {color(s.radiance)} }}"]
        case model.RectangleLight():
            glow = f"emissive {{ color = {color(s.radiance)}, sides = front }}"
            return [f"material glow{index}: {glow}", thing(f"lamp{index}", f"glow{index}", s)]
    raise TypeError(s)


def text(scene, size):
    """The whole file, for a picture of this size."""
    lines = ["rts 1", f"/// Written by `tests/peers/peers.py`: {scene.shows}.", ""]
    lines += [f'asset {name} = gltf("{name}.glb")' for name in scene.meshes()]
    lines += [medium(name, m.interior) for name, m in scene.materials.items()
              if isinstance(m, model.Glass) and m.interior]
    lines += [material(name, m) for name, m in scene.materials.items()]
    lines += [thing(f"thing{i}", t.material, t) for i, t in enumerate(scene.things)]
    for i, s in enumerate(scene.lights):
        lines += light(i, s)
    if scene.sky:
        lines.append(f"sky above: constant {{ color = {color(scene.sky)} }}")
    c = scene.camera
    lines += [
        f"camera eye: perspective {{ from = {numbers(c.origin)}m, to = {numbers(c.to)}m, fov.vertical = {c.fov}deg }}",
        f"film picture {{ size = {numbers(size)}px }}",
        f"render main: path {{ samples = 64, depth = {scene.depth} }}",
    ]
    return "\n".join(lines) + "\n"


def write(folder, scene, size):
    """Writes the scene, named after itself, and its meshes into the folder; the number of triangles of the meshes."""
    count = 0
    for name in scene.meshes():
        vertices, triangles = meshes.make(name)
        mesh_files.write_glb(folder / f"{name}.glb", vertices, triangles)
        count += len(triangles)
    (folder / f"{scene.name}.rts").write_text(text(scene, size))
    return count
