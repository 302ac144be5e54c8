"""The Cog Integration Utilities: getting plug-in modules and telling an application of them."""
