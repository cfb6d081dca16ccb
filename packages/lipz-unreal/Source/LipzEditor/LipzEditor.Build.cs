using UnrealBuildTool;

/// <summary>The editor module, which imports banks.</summary>
public class LipzEditor : ModuleRules
{
	public LipzEditor(ReadOnlyTargetRules Target) : base(Target)
	{
		PCHUsage = PCHUsageMode.UseExplicitOrSharedPCHs;
		PrivateDependencyModuleNames.AddRange(new string[] { "Core", "CoreUObject", "Engine", "UnrealEd", "Lipz" });
	}
}
