using System.IO;
using UnrealBuildTool;

/// <summary>The runtime module, with the C library of lipz for the platform.</summary>
public class Lipz : ModuleRules
{
	public Lipz(ReadOnlyTargetRules Target) : base(Target)
	{
		PCHUsage = PCHUsageMode.UseExplicitOrSharedPCHs;
		PublicDependencyModuleNames.AddRange(new string[] { "Core", "CoreUObject", "Engine" });

		string Folder = Path.GetFullPath(Path.Combine(ModuleDirectory, "..", "ThirdParty", "lipz", Target.Platform.ToString()));
		string Library = Path.Combine(Folder, "lib", Target.Platform == UnrealTargetPlatform.Win64 ? "lipz.lib" : "liblipz.a");
		if (!File.Exists(Library))
		{
			throw new BuildException("{0} is missing: unpack the C library of lipz into {1}", Library, Folder);
		}
		PublicSystemIncludePaths.Add(Path.Combine(Folder, "include"));
		PublicAdditionalLibraries.Add(Library);
	}
}
