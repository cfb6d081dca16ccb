using UnityEngine;

/// <summary>A mouth of four corners with a few blend shapes of ARKit.</summary>
internal static class FaceMesh
{
    private const float FullWeight = 100f;

    /// <summary>Makes the mesh: left, top, right and bottom.</summary>
    internal static Mesh Make()
    {
        var mesh = new Mesh
        {
            vertices = new[] { Vector(-0.3f, 0f), Vector(0f, 0.05f), Vector(0.3f, 0f), Vector(0f, -0.05f) },
            triangles = new[] { 0, 1, 2, 0, 2, 3 },
        };
        Add(mesh, "jawOpen", Vector(0f, 0f), Vector(0f, 0f), Vector(0f, 0f), Vector(0f, -0.3f));
        Add(mesh, "mouthFunnel", Vector(0.1f, 0f), Vector(0f, 0.05f), Vector(-0.1f, 0f), Vector(0f, -0.05f));
        Add(mesh, "mouthPucker", Vector(0.2f, 0f), Vector(0f, 0f), Vector(-0.2f, 0f), Vector(0f, 0f));
        Add(mesh, "mouthSmileLeft", Vector(0f, 0f), Vector(0f, 0f), Vector(0.1f, 0.1f), Vector(0f, 0f));
        Add(mesh, "mouthSmileRight", Vector(-0.1f, 0.1f), Vector(0f, 0f), Vector(0f, 0f), Vector(0f, 0f));
        Add(mesh, "mouthFrownLeft", Vector(0f, 0f), Vector(0f, 0f), Vector(0f, -0.1f), Vector(0f, 0f));
        Add(mesh, "mouthFrownRight", Vector(0f, -0.1f), Vector(0f, 0f), Vector(0f, 0f), Vector(0f, 0f));
        return mesh;
    }

    private static void Add(Mesh mesh, string name, params Vector3[] moves)
    {
        mesh.AddBlendShapeFrame(name, FullWeight, moves, null, null);
    }

    private static Vector3 Vector(float x, float y)
    {
        return new Vector3(x, y, 0f);
    }
}
