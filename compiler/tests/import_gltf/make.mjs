// Makes the compressed files beside this one with the encoders that most exporters use, Google's Draco and Binomial's
// Basis Universal:
//
//     npm install @gltf-transform/core@4.5.1 @gltf-transform/extensions@4.5.1 draco3dgltf@1.5.7 ktx2-encoder@0.6.0
//     node make.mjs
//
// What they hold is given by formulas, which `compressed.rs` has, too.

import { writeFile } from "node:fs/promises";
import { Document, NodeIO } from "@gltf-transform/core";
import { KHRDracoMeshCompression } from "@gltf-transform/extensions";
import draco3d from "draco3dgltf";
import { encodeToKTX2 } from "ktx2-encoder";

const here = new URL(".", import.meta.url);

/// A torus with a seam in its UVs, and colours and joints of 8 bits as files have them.
function torus(around, across) {
    const rows = around + 1, columns = across + 1;
    const [positions, normals, uvs, colors, joints, indices] = [[], [], [], [], [], []];
    for (let i = 0; i < rows; i++) {
        for (let j = 0; j < columns; j++) {
            const [u, v] = [i / around, j / across];
            const [a, b] = [2 * Math.PI * u, 2 * Math.PI * v];
            normals.push(Math.cos(b) * Math.cos(a), Math.cos(b) * Math.sin(a), Math.sin(b));
            const far = 2 + Math.cos(b);
            positions.push(far * Math.cos(a), far * Math.sin(a), Math.sin(b));
            uvs.push(u, v);
            colors.push(Math.round(255 * u), Math.round(255 * v), 99, 255);
            joints.push(i % 2, 0, 0, 0);
        }
    }
    for (let i = 0; i < around; i++) {
        for (let j = 0; j < across; j++) {
            const corner = i * columns + j;
            indices.push(corner, corner + columns, corner + columns + 1);
            indices.push(corner, corner + columns + 1, corner + 1);
        }
    }
    return {
        POSITION: ["VEC3", new Float32Array(positions)], NORMAL: ["VEC3", new Float32Array(normals)],
        TEXCOORD_0: ["VEC2", new Float32Array(uvs)], COLOR_0: ["VEC4", new Uint8Array(colors)],
        JOINTS_0: ["VEC4", new Uint8Array(joints)], indices: ["SCALAR", new Uint16Array(indices)],
    };
}

async function draco(name, method) {
    const document = new Document();
    const buffer = document.createBuffer();
    const primitive = document.createPrimitive();
    for (const [semantic, [type, values]] of Object.entries(torus(12, 8))) {
        const accessor = document.createAccessor().setType(type).setArray(values).setBuffer(buffer);
        accessor.setNormalized(semantic === "COLOR_0");
        if (semantic === "indices") primitive.setIndices(accessor);
        else primitive.setAttribute(semantic, accessor);
    }
    const node = document.createNode("torus").setMesh(document.createMesh().addPrimitive(primitive));
    document.createScene().addChild(node);
    document.createExtension(KHRDracoMeshCompression).setRequired(true).setEncoderOptions({
        method: KHRDracoMeshCompression.EncoderMethod[method],
        quantizationBits: { POSITION: 14, NORMAL: 10, TEX_COORD: 12, COLOR: 8, GENERIC: 12 },
    });
    const io = new NodeIO().registerExtensions([KHRDracoMeshCompression]).registerDependencies({
        "draco3d.encoder": await draco3d.createEncoderModule(),
        "draco3d.decoder": await draco3d.createDecoderModule(),
    });
    await writeFile(new URL(name, here), await io.writeBinary(document));
}

/// 18 x 10 texels, no multiple of the 4 x 4 of a block, brighter to the right and downwards; the left half is half there.
function picture(alpha) {
    const [width, height] = [18, 10];
    const data = new Uint8Array(4 * width * height);
    for (let y = 0; y < height; y++) {
        for (let x = 0; x < width; x++) {
            const at = 4 * (y * width + x);
            const light = 8 * x + 6 * y;
            data.set([40 + light, 60 + light, 20 + light, alpha && x < width / 2 ? 128 : 255], at);
        }
    }
    return { data, width, height };
}

async function ktx2(name, { alpha, ...options }) {
    const imageDecoder = async () => picture(alpha);
    const bytes = await encodeToKTX2(new Uint8Array(1), { generateMipmap: false, imageDecoder, ...options });
    await writeFile(new URL(name, here), bytes);
}

await draco("edgebreaker.glb", "EDGEBREAKER");
await draco("sequential.glb", "SEQUENTIAL");
await ktx2("etc1s.ktx2", { isUASTC: false, qualityLevel: 255, generateMipmap: true });
await ktx2("etc1s-alpha.ktx2", { isUASTC: false, qualityLevel: 255, alpha: true });
await ktx2("uastc.ktx2", { isUASTC: true, needSupercompression: false });
await ktx2("uastc-zstd.ktx2", { isUASTC: true, needSupercompression: true, generateMipmap: true, alpha: true });
