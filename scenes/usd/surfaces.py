"""`UsdPreviewSurface` → materials of glTF.

What glTF has no place for is said, once for each material.
"""

from pxr import Ar, Sdf, UsdShade

MIMES = {b"\x89PNG": "image/png", b"\xff\xd8\xff": "image/jpeg"}


class Texture:
    """A `UsdUVTexture`: its file, and which channels are read."""

    def __init__(self, shader, output):
        self.channels = output
        path = shader.GetInput("file").Get() if shader.GetInput("file") else None
        self.path = (path.resolvedPath or path.path) if isinstance(path, Sdf.AssetPath) else ""
        self.plain = all(shader.GetInput(name).Get() == value if shader.GetInput(name) else True
                         for name, value in (("scale", (1, 1, 1, 1)), ("bias", (0, 0, 0, 0))))


class Surfaces:
    """Materials by path; each is made when it is first asked for."""

    def __init__(self, glb, time, say):
        self.glb, self.time, self.say = glb, time, say
        self.known, self.images = {}, {}

    def plain(self, color):
        """A surface of one colour without a material."""
        key = tuple(round(x, 6) for x in color)
        if key not in self.known:
            factor = [*map(float, color), 1.0]
            self.known[key] = self.glb.material({"name": "display_color", "pbrMetallicRoughness": {
                "baseColorFactor": factor, "metallicFactor": 0.0, "roughnessFactor": 0.5}})
        return self.known[key]

    def index(self, material):
        """The index in the file."""
        path = material.GetPath()
        if path not in self.known:
            self.known[path] = self.glb.material(self.made(material))
        return self.known[path]

    def read(self, shader, name, default):
        """The value of an input, or the texture that it is connected to."""
        source = shader.GetInput(name)
        if not source:
            return default
        for attribute in source.GetValueProducingAttributes():
            upstream = UsdShade.Shader(attribute.GetPrim())
            if upstream and upstream.GetIdAttr().Get() == "UsdUVTexture":
                return Texture(upstream, attribute.GetBaseName())
            value = attribute.Get(self.time)
            return default if value is None else value
        return default

    def texture(self, texture, what):
        """The index of its image, or `None`."""
        if texture.path not in self.images:
            asset = Ar.GetResolver().OpenAsset(Ar.ResolvedPath(texture.path)) if texture.path else None
            data = bytes(asset.GetBuffer()) if asset else b""
            mime = next((mime for magic, mime in MIMES.items() if data.startswith(magic)), None)
            if mime is None:
                self.say(f"{what}: {texture.path or 'a texture without a file'} is no PNG or JPEG that can be read")
            self.images[texture.path] = self.glb.image(data, mime) if mime else None
        return self.images[texture.path]

    def made(self, material):
        name = material.GetPrim().GetName()
        shader, *_ = material.ComputeSurfaceSource()
        if not shader or shader.GetIdAttr().Get() != "UsdPreviewSurface":
            self.say(f"material {name}: is no UsdPreviewSurface; it becomes grey")
            return {"name": name, "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.5, 0.5, 1], "metallicFactor": 0}}
        get = lambda key, default: self.read(shader, key, default)  # noqa: E731
        if get("useSpecularWorkflow", 0):
            self.say(f"material {name}: its specular colour is left out")
        out = {"name": name, "pbrMetallicRoughness": {}, "extensions": {}}
        self.base(name, get, out)
        self.rough(name, get, out["pbrMetallicRoughness"])
        self.emission(name, get, out)
        ior, coat = get("ior", 1.5), get("clearcoat", 0.0)
        if not isinstance(ior, Texture) and ior != 1.5:
            out["extensions"]["KHR_materials_ior"] = {"ior": float(ior)}
        if isinstance(coat, Texture):
            self.say(f"material {name}: the texture of its coat is left out")
        elif coat:
            rough = get("clearcoatRoughness", 0.01)
            out["extensions"]["KHR_materials_clearcoat"] = {
                "clearcoatFactor": float(coat),
                "clearcoatRoughnessFactor": 0.01 if isinstance(rough, Texture) else float(rough)}
        normal = get("normal", None)
        if isinstance(normal, Texture) and (index := self.texture(normal, f"material {name}")) is not None:
            out["normalTexture"] = {"index": index}
        if isinstance(get("displacement", 0.0), Texture):
            self.say(f"material {name}: displacement is left out")
        if not out["extensions"]:
            del out["extensions"]
        return out

    def base(self, name, get, out):
        """Colour and coverage."""
        color, opacity, cut = get("diffuseColor", (0.18, 0.18, 0.18)), get("opacity", 1.0), get("opacityThreshold", 0.0)
        pbr, factor = out["pbrMetallicRoughness"], [1.0, 1.0, 1.0, 1.0]
        if isinstance(color, Texture):
            if not color.plain:
                self.say(f"material {name}: scale and bias of its colour are left out")
            if (index := self.texture(color, f"material {name}")) is not None:
                pbr["baseColorTexture"] = {"index": index}
        else:
            factor[:3] = map(float, color)
        covers = True
        if not isinstance(opacity, Texture):
            factor[3], covers = float(opacity), opacity >= 1
        elif isinstance(color, Texture) and opacity.path == color.path and opacity.channels == "a":
            covers = False
        else:
            self.say(f"material {name}: its opacity is no alpha of its colour; it is left out")
        pbr["baseColorFactor"] = factor
        if not covers:
            out["alphaMode"] = "MASK" if cut else "BLEND"
            if cut:
                out["alphaCutoff"] = float(cut)

    def rough(self, name, get, pbr):
        """glTF reads roughness from green and metallic from blue of one image."""
        rough, metal = get("roughness", 0.5), get("metallic", 0.0)
        files = {x.path for x in (rough, metal) if isinstance(x, Texture)}
        fits = len(files) == 1 and all(not isinstance(x, Texture) or x.channels == channel
                                       for x, channel in ((rough, "g"), (metal, "b")))
        if files and not fits:
            self.say(f"material {name}: textures of roughness and metallic are not green and blue of one image; they are "
                     "left out")
        for key, value, default in (("roughnessFactor", rough, 0.5), ("metallicFactor", metal, 0.0)):
            if isinstance(value, Texture):
                pbr[key] = 1.0 if fits else default
            else:
                pbr[key] = float(value)
        if fits:
            texture = rough if isinstance(rough, Texture) else metal
            if (index := self.texture(texture, f"material {name}")) is not None:
                pbr["metallicRoughnessTexture"] = {"index": index}

    def emission(self, name, get, out):
        light = get("emissiveColor", (0, 0, 0))
        if isinstance(light, Texture):
            if (index := self.texture(light, f"material {name}")) is not None:
                out["emissiveTexture"], out["emissiveFactor"] = {"index": index}, [1.0, 1.0, 1.0]
        elif (most := max(light)) > 0:
            out["emissiveFactor"] = [float(x) / max(most, 1) for x in light]
            if most > 1:
                out["extensions"]["KHR_materials_emissive_strength"] = {"emissiveStrength": float(most)}
